#include "tests/numerics/document.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>

#include "tests/numerics/catalog.hpp"
#include "tests/numerics/finding.hpp"
#include "tests/numerics/light_cases.hpp"
#include "tests/numerics/plot.hpp"

namespace scenec::numerics {
namespace {

constexpr char separator = '\x1f';
constexpr std::string_view finding_key = "finding";
constexpr std::string_view series_key = "series";

std::vector<std::string> fields_of(std::string_view text) {
  std::vector<std::string> out(1);
  for (const char c : text) {
    if (c == separator)
      out.emplace_back();
    else
      out.back() += c;
  }
  return out;
}

std::vector<double> numbers_of(std::string_view text) {
  std::istringstream in{std::string(text)};
  std::vector<double> out;
  for (double v = 0; in >> v;) out.push_back(v);
  return out;
}

std::string joined(const std::vector<double>& v) {
  std::string out;
  for (const double x : v) out += fmt::format("{} ", x);
  return out;
}

struct Row {
  std::string input;
  std::string rays;
  std::string worst;
  std::string textbook;
};

struct Results {
  std::map<std::string, std::vector<Row>> rows;       // by case
  std::map<std::string, std::vector<Series>> series;  // by plot
};

void collect(const testing::TestResult& result, Results& out) {
  for (int i = 0; i < result.test_property_count(); ++i) {
    const testing::TestProperty& property = result.GetTestProperty(i);
    const std::string_view key = property.key();
    const std::vector<std::string> f = fields_of(property.value());
    if (key.starts_with(finding_key) && f.size() == 5)
      out.rows[f[0]].push_back({f[1], f[2], f[3], f[4]});
    if (key.starts_with(series_key) && f.size() == 4)
      out.series[f[0]].push_back({{}, f[1], numbers_of(f[2]), numbers_of(f[3])});
  }
}

Results results_of_run() {
  Results out;
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  for (int i = 0; i < all.total_test_suite_count(); ++i) {
    const testing::TestSuite& suite = *all.GetTestSuite(i);
    for (int k = 0; k < suite.total_test_count(); ++k)
      if (suite.GetTestInfo(k)->should_run()) collect(*suite.GetTestInfo(k)->result(), out);
  }
  return out;
}

// Properties of one test need names of their own.
std::string next_key(std::string_view stem) {
  const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
  return fmt::format("{}{}", stem, test->result()->test_property_count());
}

// `|` ends a cell unless escaped.
std::string cell(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '|') out += '\\';
    out += c;
  }
  return out;
}

std::string table_of(const std::vector<Row>& rows) {
  const bool textbook =
      std::any_of(rows.begin(), rows.end(), [](const Row& r) { return !r.textbook.empty(); });
  std::string out =
      textbook ? "| input | rays | worst measured | textbook formula |\n|---|--:|---|---|\n"
               : "| input | rays | worst measured |\n|---|--:|---|\n";
  for (const Row& r : rows) {
    out += fmt::format("| {} | {} | {} |", cell(r.input), r.rays, cell(r.worst));
    out += textbook ? fmt::format(" {} |\n", cell(r.textbook)) : "\n";
  }
  return out;
}

std::string generated_part(const Results& results, std::vector<std::string>& complaints) {
  std::string out;
  for (const Section& section : sections()) {
    out += fmt::format("\n## {}\n\n{}\n", section.title, section.text);
    for (const Case& c : section.cases) {
      const auto found = results.rows.find(std::string(c.id));
      if (found == results.rows.end()) {
        complaints.push_back(fmt::format("case {} of the catalog was measured by no test", c.id));
        continue;
      }
      out += fmt::format("\n### {}: {}\n\n{} **Bound:** {}\n\n{}", c.id, c.title, c.claim, c.bound,
                         table_of(found->second));
      for (const Plot& plot : plots())
        if (plot.case_id == c.id)
          out += fmt::format("\n![{}](numerics/{}.svg)\n", plot.title, plot.name);
    }
  }
  return out;
}

void complain_of_strangers(const Results& results, std::vector<std::string>& complaints) {
  for (const auto& [id, rows] : results.rows) {
    const auto knows = [&](const Section& s) {
      return std::any_of(s.cases.begin(), s.cases.end(), [&](const Case& c) { return c.id == id; });
    };
    if (!std::any_of(sections().begin(), sections().end(), knows))
      complaints.push_back(fmt::format("case {} is not in the catalog", id));
  }
}

std::string content_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

void settle(const std::filesystem::path& path, const std::string& want,
            std::vector<std::string>& complaints) {
  const std::string is = content_of(path);
  if (is == want) return;
  if (std::getenv("SCENEC_UPDATE_DOCS") != nullptr) {
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << want;
    return;
  }
  std::istringstream a(is);
  std::istringstream b(want);
  std::string stale;
  std::string fresh;
  do {
    stale.clear();
    fresh.clear();
  } while (std::getline(a, stale) && std::getline(b, fresh) && stale == fresh);
  complaints.push_back(fmt::format(
      "{} is stale; run scenec-numerics with SCENEC_UPDATE_DOCS=1 and read the difference\n"
      "  it says:  {}\n  measured: {}",
      path.filename().string(), stale, fresh));
}

// What stands between two marks; false: they are not there.
bool replace_part(std::string& text, std::string_view begin, std::string_view end,
                  const std::string& part) {
  const std::size_t from = text.find(begin);
  const std::size_t to = text.find(end);
  if (from == std::string::npos || to == std::string::npos || to < from) return false;
  const std::size_t first = from + begin.size();
  text.replace(first, to - first, part + "\n");
  return true;
}

}  // namespace

void record(const Finding& finding) {
  testing::Test::RecordProperty(
      next_key(finding_key),
      fmt::format("{1}{0}{2}{0}{3}{0}{4}{0}{5}", separator, finding.id, finding.input, finding.rays,
                  finding.worst, finding.textbook));
}

void record(const Series& series) {
  testing::Test::RecordProperty(next_key(series_key),
                                fmt::format("{1}{0}{2}{0}{3}{0}{4}", separator, series.plot,
                                            series.name, joined(series.x), joined(series.y)));
}

bool document_agrees(const std::filesystem::path& docs, std::vector<std::string>& complaints) {
  const Results results = results_of_run();
  const std::filesystem::path page = docs / "numerics.md";
  std::string text = content_of(page);
  complain_of_strangers(results, complaints);
  const bool marked =
      replace_part(text, "<!-- generated: scenec-numerics -->\n",
                   "<!-- end of the generated part -->\n", generated_part(results, complaints)) &&
      replace_part(text, "<!-- generated: cases of light -->\n",
                   "<!-- end of the cases of light -->\n", light_case_table());
  if (!marked) {
    complaints.push_back("numerics.md has no marks for its generated parts");
    return false;
  }
  settle(page, text, complaints);
  for (const Plot& plot : plots()) {
    const auto series = results.series.find(std::string(plot.name));
    if (series == results.series.end())
      complaints.push_back(fmt::format("plot {} has no figures", plot.name));
    else
      settle(docs / "numerics" / fmt::format("{}.svg", plot.name), svg_of(plot, series->second),
             complaints);
  }
  return complaints.empty();
}

}  // namespace scenec::numerics
