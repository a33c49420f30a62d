// A smooth function of the inclination theta (and of the stress on the sides), learnt from a few cells of a
// table: a Gaussian process (Rasmussen & Williams 2006, chapter 2) of zero mean.
//
// Layers look the same at theta, -theta and 180 - theta. So the process is even about 0 and 90 degrees: the
// periodic covariance in a = 2 theta, plus that of the mirror image,
//
//   k(a, b) = c(a - b) + c(a + b),   c(d) = exp(-2 sin^2(d/2)/l^2),   scaled to one at a = b
//
// Over the stress it is a level and a slope, each such a function of theta:
//
//   level(theta) + slope(theta) (stress - middle of the cells)/0.2
//
// Cells of one stress say nothing of the slope: away from them the level stays, and the doubt grows. Six
// cells settle neither the sizes nor the length l. So these are averaged over a grid, weighed by the
// likelihood and a prior: exponential in both sizes, which is largest at no function at all (Simpson et al.
// 2017), even in the four lengths.
//
// Rejected: a covariance that falls with the difference of the stresses. Cells of one stress that are met
// then vouch for every stress (measured/confined-prediction.csv).
#pragma once
#include <Eigen/Core>
#include <vector>

namespace phy {

struct AnglePlace {
  double theta = 0.0;   ///< [deg]
  double stress = 0.0;  ///< on the sides, as a part of the strength
};

struct AngleCell {
  AnglePlace place;
  double value = 0.0;
  double noise = 0.0;  ///< variance of the value about what is wanted at the cell
  double own = 0.0;    ///< variance of what is wanted at the cell about the function; wanted there alone
};

class AngleProcess {
 public:
  /// `usual_size`: mean of the prior of the standard deviation of the level, and of what the slope adds to
  /// it over a fifth of the strength.
  AngleProcess(const std::vector<AngleCell>& cells, double usual_size);

  /// A prediction is `weights` times the values of the cells.
  struct Prediction {
    Eigen::VectorXd weights;
    double mean = 0.0;  ///< by the values that the process has learnt from
    double variance = 0.0;
  };
  /// The function at a place.
  Prediction at(const AnglePlace& place) const;
  /// What is wanted at a cell that the process has seen: the function and the cell's own deviation.
  Prediction of_cell(std::size_t i) const;
  /// Mean of the standard deviation of the level, after the cells have spoken.
  double size() const;

 private:
  /// One choice of sizes and length.
  struct Node {
    double level = 0.0, slope = 0.0, length = 0.0;
    double weight = 0.0;      ///< its part in the averages
    Eigen::MatrixXd inverse;  ///< of the covariance of the values
  };
  std::vector<AngleCell> cells_;
  Eigen::VectorXd values_;
  std::vector<Node> nodes_;
  double middle_ = 0.0;  // of the cells' stresses

  double covariance(const Node& node, const AnglePlace& p, const AnglePlace& q) const;
  void learn(Node& node) const;
  Prediction predicted(const AnglePlace& place, std::size_t own_of) const;
};

}  // namespace phy
