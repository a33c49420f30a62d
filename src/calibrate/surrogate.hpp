// A stand-in for the press between its runs: log(strength/sigma_c) of one test at one angle over the box of
// strength ratios, learnt from all runs so far.
//
// Gaussian process (Rasmussen & Williams 2006, chapter 2) with a kernel that says what is known beforehand:
//
//   k = constant + slopes + curvatures + a smooth remainder           the response itself
//     + [both coarse] (constant + slopes)                             what coarse grains answer differently
//     + [same packing] + [same run]                                   scatter of packings, of runs
//
// z in [-1, 1] spans the box in logarithms. Where the response is predicted (prior_regression.hpp), the
// process is that of the difference to what is predicted, with smaller amplitudes. The amplitudes are those
// of typical rocks in this box; two factors, one on response and one on scatter, follow from the runs by
// their posterior mode. The value asked for is that of fine grains, mean over packings: only the first line
// of k takes part, and its variance says how well the runs have settled it. Rejected: one length per
// parameter by maximum likelihood, thirty runs do not fix it.
#pragma once
#include <Eigen/Core>
#include <functional>
#include <span>
#include <vector>

#include "maps/prior_regression.hpp"

namespace phy::calibrate {

struct SurrogateRun {
  std::vector<double> z;  ///< point of the box, every component in [-1, 1]
  int packing = 0;        ///< runs of one packing share their scatter
  bool coarse = false;
  double y = 0.0;  ///< logarithm of the answer
};

class Surrogate {
 public:
  struct Value {
    double mean = 0.0, variance = 0.0;
  };
  /// Without runs it knows what is predicted.
  explicit Surrogate(const std::vector<SurrogateRun>& runs, maps::PriorMean prior_mean = {});
  Value at(std::span<const double> z) const;
  /// Of that variance, what rests on the packings of fine grains that there were: all runs of one share it.
  double packing_variance() const { return packing_variance_; }
  /// Of the logarithm of one run on fine grains about the response: packing and run together.
  double scatter_variance() const { return scatter_variance_; }

 private:
  maps::PriorMean prior_;
  Eigen::MatrixXd places_;  // of the runs, one per row
  Eigen::ArrayXd squares_;  // of their lengths
  double response_ = 1.0;   // factor on the amplitudes
  double packing_variance_ = 0.0, scatter_variance_ = 0.0;
  Eigen::MatrixXd factor_;    // Cholesky factor of the covariance of the runs
  Eigen::MatrixXd whitener_;  // its inverse, a row per column
  Eigen::VectorXd weights_;   // of the runs

  struct Shared;  // parts of that covariance
  /// Returns the log likelihood.
  double learn(const Eigen::VectorXd& y, const Shared& shared, double response, double scatter);
  /// Covariance of the response of fine grains, mean over packings, with every run.
  Eigen::ArrayXd response_kernel(const Eigen::Ref<const Eigen::VectorXd>& z) const;
  double response_variance(double square) const;
};

}  // namespace phy::calibrate
