// Every tutorial of docs/tutorials is done as it is written; tests/soak has those that take long.
#include "../tutorial.hpp"

namespace tutorial {

TEST_P(Tutorial, IsDoneAsItIsWritten) { do_as_written(GetParam()); }
INSTANTIATE_TEST_SUITE_P(Of, Tutorial, testing::ValuesIn(pages(false)), name_of);

}  // namespace tutorial
