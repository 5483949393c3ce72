// What SARIF 2.1.0 (OASIS standard, sections 3.13 to 3.58, and its JSON schema) demands of the
// objects scenec writes: required properties, no others, enumerations, lowest numbers, arrays whose
// elements differ, and the forms of URIs. Written from the standard; anything scenec begins to
// write beyond these objects fails until its rules are added here.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace scenec::test {

// Every violation, with the path to it; empty: the log is valid.
[[nodiscard]] std::vector<std::string> sarif_problems(const nlohmann::json& log);

}  // namespace scenec::test
