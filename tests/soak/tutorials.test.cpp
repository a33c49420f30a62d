// The tutorials that take long, done as they are written: from a laboratory's table to a drawing of an
// opening. What a page says of a result stands below the command that printed it, and has to be printed here.
#include "../tutorial.hpp"

namespace tutorial {

class LongTutorial : public Tutorial {};

TEST_P(LongTutorial, IsDoneAsItIsWritten) { do_as_written(GetParam()); }
INSTANTIATE_TEST_SUITE_P(Of, LongTutorial, testing::ValuesIn(pages(true)), name_of);

}  // namespace tutorial
