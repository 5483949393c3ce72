// `scenec-bench rays DUMP --mesh FILE [--threads N] [--target NAME] [--repeat N] [--list N]`:
// recorded rays through our accelerator, timed, and checked against the recorded hits.
#pragma once

namespace scenec::bench {

// The arguments behind `rays`; returns the process's exit code.
int run_rays(int count, char** arguments);

}  // namespace scenec::bench
