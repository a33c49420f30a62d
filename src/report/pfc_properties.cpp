#include "report/pfc_properties.hpp"

#include <fmt/format.h>

#include <utility>

namespace phy::report {

std::string pfc_joint_properties(const BeddingRecipe& set) {
  const std::pair<const char*, double> list[] = {{"sj_kn", set.k_n},      {"sj_ks", set.k_s},
                                                 {"sj_fric", set.mu},     {"sj_da", set.psi},
                                                 {"sj_ten", set.sigma_n}, {"sj_coh", set.cohesion},
                                                 {"sj_fa", set.phi},      {"sj_rmul", set.radius_multiplier}};
  std::string text;
  for (const auto& [name, value] : list)
    // Eight digits: a person may read and edit these; bits of parameters decide nothing in another program.
    text += fmt::format("        contact.prop(c,'{}') = {:.8g}\n", name, value);
  return text;
}

std::string pfc_matrix_properties(const MatrixRecipe& m) {
  // The deformability method of PFC 5 divides by the length of the contact, PFC 3.1 did not: the same E_c is
  // another stiffness.
  const bool pfc5 = m.stiffness_convention == StiffnessConvention::pfc5;
  std::string text =
      pfc5 ? fmt::format(
                 "contact method deformability emod {:.8g} kratio {:.8g} range contact type 'ball-ball'\n",
                 m.E_c, 1.0 / m.ks_over_kn)
           : fmt::format(
                 "contact property kn {:.8g} ks {:.8g} range contact type 'ball-ball'   ; PFC 3.1: k_n = "
                 "E_c t\n",
                 m.E_c, m.ks_over_kn * m.E_c);
  return text +
         fmt::format(
             "contact method pb_deformability emod {:.8g} kratio {:.8g} range contact type 'ball-ball'\n"
             "contact property fric {:.8g} pb_rmul {:.8g} pb_mcf {:.8g} pb_fa {:.8g} lin_mode 1 range "
             "contact type 'ball-ball'\n",
             m.E_b, 1.0 / m.bond_ks_over_kn, m.mu, m.radius_multiplier, m.moment_contribution, m.phi);
}

}  // namespace phy::report
