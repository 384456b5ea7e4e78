// Obstacles around a robot.

#ifndef URDD_OBSTACLE_HPP
#define URDD_OBSTACLE_HPP

#include "core.hpp"

namespace urdd {

/// A body that a robot must not touch, in the root link's frame; or that a link carries, in the frame of the link.
class Obstacle {
public:
    /// A box: the pose of its centre and axes, and its half extents, metres.
    static Obstacle cuboid(const std::string &name, const Pose &pose, const Point &half_extents) {
        return Obstacle(detail::made<urdd_obstacle>([&](urdd_obstacle **out) {
            return urdd_obstacle_cuboid(detail::c_text(name), pose.data(), half_extents.data(), out);
        }));
    }
    /// A sphere: its centre and radius, metres.
    static Obstacle sphere(const std::string &name, const Point &centre, double radius) {
        return Obstacle(detail::made<urdd_obstacle>([&](urdd_obstacle **out) {
            return urdd_obstacle_sphere(detail::c_text(name), centre.data(), radius, out);
        }));
    }
    /// All points within `radius` of a segment along the z axis, from -`half_length` to `half_length`, metres.
    static Obstacle capsule(const std::string &name, const Pose &pose, double radius, double half_length) {
        return Obstacle(detail::made<urdd_obstacle>([&](urdd_obstacle **out) {
            return urdd_obstacle_capsule(detail::c_text(name), pose.data(), radius, half_length, out);
        }));
    }
    /// A cylinder along the z axis, from -`half_length` to `half_length`, metres: a circumscribed prism with 64 sides.
    static Obstacle cylinder(const std::string &name, const Pose &pose, double radius, double half_length) {
        return Obstacle(detail::made<urdd_obstacle>([&](urdd_obstacle **out) {
            return urdd_obstacle_cylinder(detail::c_text(name), pose.data(), radius, half_length, out);
        }));
    }
    /// The convex hull of points, metres.
    static Obstacle hull(const std::string &name, const Pose &pose, Argument<const Point> points) {
        const double *values = points.size() == 0 ? nullptr : points.data()->data();
        return Obstacle(detail::made<urdd_obstacle>([&](urdd_obstacle **out) {
            return urdd_obstacle_hull(detail::c_text(name), pose.data(), values, points.size(), out);
        }));
    }
    /// A mesh, decomposed into convex pieces as `urdd generate` does, at the same cost.
    static Obstacle mesh(const std::string &name, const Pose &pose, Argument<const Point> vertices,
                         Argument<const std::array<std::uint32_t, 3>> triangles) {
        const double *values = vertices.size() == 0 ? nullptr : vertices.data()->data();
        const std::uint32_t *corners = triangles.size() == 0 ? nullptr : triangles.data()->data();
        return Obstacle(detail::made<urdd_obstacle>([&](urdd_obstacle **out) {
            return urdd_obstacle_mesh(detail::c_text(name), pose.data(), values, vertices.size(), corners,
                                      triangles.size(), out);
        }));
    }

    /// A cloud of points, metres, such as a depth camera sees: all points that are at most `radius` from one of them; 0
    /// is allowed. A tree finds those near a shape: 100,000 are fine.
    static Obstacle points(const std::string &name, const Pose &pose, Argument<const Point> points, double radius) {
        const double *values = points.size() == 0 ? nullptr : points.data()->data();
        return Obstacle(detail::made<urdd_obstacle>([&](urdd_obstacle **out) {
            return urdd_obstacle_points(detail::c_text(name), pose.data(), values, points.size(), radius, out);
        }));
    }
    /// A field of heights over the x-y plane of its frame, row by row: each is a column with the sizes `cell` along x
    /// and y, metres, its centre at x = column * cell[0], y = row * cell[1]. It reaches from its height, metres,
    /// `thickness` down.
    static Obstacle height_field(const std::string &name, const Pose &pose, Argument<const double> heights,
                                 std::size_t columns, const std::array<double, 2> &cell, double thickness) {
        const std::size_t rows = columns == 0 ? 0 : heights.size() / columns;
        detail::same_size("heights", heights.size(), rows * columns);
        return Obstacle(detail::made<urdd_obstacle>([&](urdd_obstacle **out) {
            return urdd_obstacle_height_field(detail::c_text(name), pose.data(), heights.data(), rows, columns,
                                              cell.data(), thickness, out);
        }));
    }

    /// The same body with its frame at another pose; the frame of a sphere is at its centre.
    Obstacle at(const Pose &pose) const {
        return Obstacle(detail::made<urdd_obstacle>(
            [&](urdd_obstacle **out) { return urdd_obstacle_at(handle_.get(), pose.data(), out); }));
    }
    /// The same obstacle with a link that may touch it, such as the base that is mounted on it.
    Obstacle ignoring(const std::string &link) const {
        return Obstacle(detail::made<urdd_obstacle>(
            [&](urdd_obstacle **out) { return urdd_obstacle_ignoring(handle_.get(), detail::c_text(link), out); }));
    }

    const urdd_obstacle *handle() const & noexcept { return handle_.get(); }
    const urdd_obstacle *handle() const && = delete; // it would be freed at once

private:
    explicit Obstacle(urdd_obstacle *handle) : handle_(handle) {}
    detail::Handle<urdd_obstacle, urdd_obstacle_free> handle_;
};

namespace detail {

/// The handles of obstacles, for C.
inline std::vector<const urdd_obstacle *> handles(Span<const Obstacle> obstacles) {
    std::vector<const urdd_obstacle *> found;
    found.reserve(obstacles.size());
    for (const Obstacle &obstacle : obstacles)
        found.push_back(obstacle.handle());
    return found;
}

} // namespace detail

} // namespace urdd

#endif
