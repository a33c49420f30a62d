#include "contact/models.hpp"

#include "contact/model.hpp"

namespace phy::contact {

const Models& standard_models() {
  static const Models first = models<std::tuple_element_t<0, Combinations>>();
  return first;
}

}  // namespace phy::contact
