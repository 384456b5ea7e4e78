// Eigen: poses and Jacobians as its matrices, configurations from them.

#ifndef URDD_EIGEN_HPP
#define URDD_EIGEN_HPP

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "robot.hpp"

namespace urdd {

/// A pose as a transform of Eigen.
inline Eigen::Isometry3d isometry(const Pose &pose) {
    Eigen::Isometry3d found;
    found.matrix() = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(pose.data());
    return found;
}
/// A transform of Eigen as a pose.
inline Pose pose(const Eigen::Isometry3d &transform) {
    Pose found{};
    Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(found.data()) = transform.matrix();
    return found;
}

/// A pose as an Eigen matrix, which refers to it.
inline Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> pose_map(const Pose &pose) {
    return Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(pose.data());
}
Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> pose_map(const Pose &&pose) = delete;

/// A Jacobian, as `Robot::jacobian` gives it, as an Eigen matrix, which refers to it.
inline Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic>> jacobian_map(Span<const double> jacobian) {
    return Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic>>(jacobian.data(), 6,
                                                                      static_cast<Eigen::Index>(jacobian.size() / 6));
}
/// The Jacobian of a point of a link, as `Robot::jacobian` gives it.
inline Eigen::Matrix<double, 6, Eigen::Dynamic> jacobian(const Robot &robot, Argument<const double> q, std::size_t link,
                                                         const Point &point = {0, 0, 0}) {
    Eigen::Matrix<double, 6, Eigen::Dynamic> found(6, static_cast<Eigen::Index>(q.size()));
    robot.jacobian(q, link, point, found);
    return found;
}

/// The rows of a matrix as configurations.
template <int ROWS, int COLUMNS, int OPTIONS> Rows rows(const Eigen::Matrix<double, ROWS, COLUMNS, OPTIONS> &matrix) {
    static_assert(COLUMNS == 1 || (OPTIONS & Eigen::RowMajor),
                  "rows of this matrix are not one after another: use Eigen::RowMajor, or transpose it");
    return {matrix.data(), static_cast<std::size_t>(matrix.rows()), static_cast<std::size_t>(matrix.cols())};
}
template <int ROWS, int COLUMNS, int OPTIONS>
Rows rows(const Eigen::Matrix<double, ROWS, COLUMNS, OPTIONS> &&matrix) = delete;

} // namespace urdd

#endif
