// Results as Eigen matrices.

#ifndef URDD_EIGEN_HPP
#define URDD_EIGEN_HPP

#include <Eigen/Core>

#include "core.hpp"

namespace urdd {

/// A pose as an Eigen matrix.
inline Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> pose_map(const Pose &pose) {
    return Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(pose.data());
}
/// A Jacobian, as `Robot::jacobian` gives it, as an Eigen matrix.
inline Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic>> jacobian_map(Span<const double> jacobian) {
    return Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic>>(jacobian.data(), 6,
                                                                      static_cast<Eigen::Index>(jacobian.size() / 6));
}

} // namespace urdd

#endif
