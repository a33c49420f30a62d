#include "jobs/result_reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "io/store.hpp"
#include "jobs/key_table.hpp"
#include "records/quality.hpp"
#include "records/test_description.hpp"
#include "report/figures.hpp"

namespace phy::jobs {
namespace {

constexpr const char* head = R"(# Tables of a result

Written by `phyllite run --reference` from the lists that the program works by. Files: [formats](formats.md).

## Measures of quality

Beyond the first limit a test carries a warning, beyond the second it is untrusted. `of` names single numbers
that a measure speaks of. [When to believe a number](reliability.md) says where the limits come from.

| measure | what it is | warning | untrusted | of | what is wrong | what to do |
|---|---|---|---|---|---|---|
)";

constexpr const char* columns_head = R"(
## Columns of a history

Of `history.csv`. The unit stands in the header: `axial_stress [Pa]`. Compression and shortening are positive.
`all` means every test.

| column | unit | of | meaning |
|---|---|---|---|
)";

constexpr const char* keys_head = R"(
## Keys of a result

Of `result.json`. `file` is the whole; other objects stand where a key names them, alone or in a list.

)";

constexpr const char* figures_head = R"(
## Kinds of figures

`--kind` of `phyllite figure`. Numbers of figures refer to the paper behind this project.

| kind | also | shows | width [mm] |
|---|---|---|---|
)";

std::string measure_row(const QualityLimit& limit) {
  const char* sign = limit.least ? "<" : ">";
  const auto bound = [&](double value) {
    return value < 0.0 ? std::string("-") : fmt::format("{} {:g}", sign, value);
  };
  std::vector<std::string> of;
  for (const std::string& number : limit.of) of.push_back("`" + number + "`");
  return fmt::format("| `{}` | {} | {} | {} | {} | {} | {} |\n", limit.number, limit.what,
                     bound(limit.warning), bound(limit.untrusted), fmt::join(of, ", "), limit.says,
                     limit.advice);
}

/// A column with one meaning is a row, whatever tests have it.
std::string column_rows() {
  struct Row {
    const HistoryColumn* column;
    std::vector<std::string> tests;
  };
  std::vector<Row> rows;
  for (const TestDescription* test : laboratory_tests())
    for (const HistoryColumn& column : test->columns) {
      const auto same = [&](const Row& row) {
        return std::string_view(row.column->name) == column.name &&
               std::string_view(row.column->meaning) == column.meaning;
      };
      auto row = std::find_if(rows.begin(), rows.end(), same);
      if (row == rows.end()) row = rows.insert(rows.end(), Row{&column, {}});
      row->tests.emplace_back("`" + std::string(test->name) + "`");
    }
  std::string text;
  for (const Row& row : rows)
    text += fmt::format(
        "| `{}` | {} | {} | {} |\n", row.column->name, row.column->unit,
        row.tests.size() == laboratory_tests().size() ? "all" : fmt::format("{}", fmt::join(row.tests, ", ")),
        row.column->meaning);
  return text;
}

}  // namespace

std::string result_reference() {
  std::string text = head;
  for (const QualityLimit& limit : quality_limits()) text += measure_row(limit);
  text += columns_head + column_rows() + keys_head + key_table(io::result_keys()) + figures_head;
  for (const report::FigureKind& kind : report::figure_kinds())
    text += fmt::format("| `{}` | {} | {} | {:g} |\n", kind.name,
                        *kind.paper != '\0' ? fmt::format("`{}`", kind.paper) : "", kind.meaning, kind.width);
  return text;
}

}  // namespace phy::jobs
