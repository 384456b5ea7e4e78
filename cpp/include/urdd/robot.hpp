// A robot.

#ifndef URDD_ROBOT_HPP
#define URDD_ROBOT_HPP

#include "collision_model.hpp"
#include "proximity.hpp"

namespace urdd {

/// The settings of inverse kinematics, with the defaults of the library.
inline urdd_inverse_settings inverse_settings() {
    urdd_inverse_settings settings{};
    detail::check(urdd_inverse_settings_default(&settings));
    return settings;
}

/// What inverse kinematics found: the configuration, and how near it comes.
struct Inverse {
    std::vector<double> configuration;
    urdd_inverse_solution solution;

    bool is_reached() const noexcept { return solution.is_reached; }
};

/// A robot, as its URDD describes it.
class Robot {
public:
    /// Opens the URDD in a folder or zip archive. Reads no module yet.
    static Robot open(const std::string &path) {
        return Robot(detail::made<urdd_robot>([&](urdd_robot **out) { return urdd_robot_open(path.c_str(), out); }));
    }
    /// Opens the URDD in a zip archive in memory, which is copied. `name` stands for it in messages.
    static Robot of_archive(const std::string &name, Span<const std::uint8_t> bytes) {
        return Robot(detail::made<urdd_robot>(
            [&](urdd_robot **out) { return urdd_robot_of_archive(name.c_str(), bytes.data(), bytes.size(), out); }));
    }

    std::size_t num_links() const { return sizes()[0]; }
    std::size_t num_joints() const { return sizes()[1]; }
    std::size_t num_dofs() const { return sizes()[2]; }
    std::vector<std::string> link_names() const { return names(num_links(), urdd_robot_link_name); }
    std::vector<std::string> joint_names() const { return names(num_joints(), urdd_robot_joint_name); }
    std::vector<std::string> dof_names() const { return names(num_dofs(), urdd_robot_dof_name); }
    /// "rad" or "m" for each DOF.
    std::vector<std::string> dof_units() const { return names(num_dofs(), urdd_robot_dof_unit); }
    /// The index of a link.
    std::size_t link(const std::string &name) const {
        std::size_t found = 0;
        detail::check(urdd_robot_link(handle_.get(), name.c_str(), &found));
        return found;
    }
    /// The index of a DOF.
    std::size_t dof(const std::string &name) const {
        std::size_t found = 0;
        detail::check(urdd_robot_dof(handle_.get(), name.c_str(), &found));
        return found;
    }

    /// The lower and the upper bound of each DOF, rad or m.
    std::vector<std::array<double, 2>> bounds() const {
        std::vector<std::array<double, 2>> found(num_dofs());
        double *values = found.empty() ? nullptr : found.data()->data();
        detail::check(urdd_robot_bounds(handle_.get(), values, 2 * found.size()));
        return found;
    }
    /// The default configuration: every DOF at 0, or at the bound nearest to 0.
    std::vector<double> zero() const { return configuration(urdd_robot_zero); }
    /// Every DOF half-way between its bounds.
    std::vector<double> middle() const { return configuration(urdd_robot_middle); }
    /// `rows` samples of the sequence of SPEC 9.3 from `first` on, one after another.
    std::vector<double> random(std::uint64_t first, std::size_t rows = 1) const {
        std::size_t dofs = num_dofs();
        std::vector<double> found(rows * dofs);
        detail::check(urdd_robot_random(handle_.get(), first, found.data(), rows, dofs));
        return found;
    }
    /// Moves each value beyond its bounds to the nearer bound.
    void clamp(Span<double> q) const { detail::check(urdd_robot_clamp(handle_.get(), q.data(), q.size())); }
    /// The largest speed of each DOF, rad/s or m/s; infinite where the source states none.
    std::vector<double> velocity_limits() const { return configuration(urdd_robot_velocity_limits); }
    /// The largest effort of each DOF, N m or N; infinite where the source states none.
    std::vector<double> effort_limits() const { return configuration(urdd_robot_effort_limits); }
    /// The mass of each link, kg, 0 where the source states none, and its centre of mass in the link's frame.
    std::vector<std::array<double, 4>> link_masses() const {
        std::vector<std::array<double, 4>> found(num_links());
        double *values = found.empty() ? nullptr : found.data()->data();
        detail::check(urdd_robot_link_masses(handle_.get(), values, 4 * found.size()));
        return found;
    }
    /// The centre of mass of the robot, in the root link's frame; NaN where the source states no mass.
    Point centre_of_mass(Span<const double> q) const {
        Point found{};
        detail::check(urdd_robot_centre_of_mass(handle_.get(), q.data(), 1, q.size(), found.data()));
        return found;
    }
    /// The names of the configurations that a person named.
    std::vector<std::string> configuration_names() const {
        std::size_t count = 0;
        detail::check(urdd_robot_num_named_configurations(handle_.get(), &count));
        return names(count, urdd_robot_configuration_name);
    }
    /// A configuration that a person named.
    std::vector<double> named_configuration(const std::string &name) const {
        std::vector<double> found(num_dofs());
        detail::check(urdd_robot_named_configuration(handle_.get(), name.c_str(), found.data(), found.size()));
        return found;
    }

    /// The pose of each link.
    std::vector<Pose> link_poses(Span<const double> q) const { return link_poses_batch({q.data(), 1, q.size()}); }
    /// The poses of all links in each configuration: rows x links.
    std::vector<Pose> link_poses_batch(Rows q) const {
        std::vector<Pose> found(q.rows * num_links());
        link_poses(q, found);
        return found;
    }
    /// As above, into `out`: rows x links.
    void link_poses(Rows q, Span<Pose> out) const {
        double *values = out.size() == 0 ? nullptr : out.data()->data();
        detail::check(urdd_robot_link_poses(handle_.get(), q.data, q.rows, q.columns, values, 16 * out.size()));
    }
    /// The geometric Jacobian of a point of a link, in the link's frame: 6 x dofs, column-major. Linear, then angular
    /// velocity, in the root link's frame.
    std::vector<double> jacobian(Span<const double> q, std::size_t link, const Point &point = {0, 0, 0}) const {
        std::vector<double> found(6 * q.size());
        jacobian(q, link, point, found);
        return found;
    }
    /// As above, into `out`.
    void jacobian(Span<const double> q, std::size_t link, const Point &point, Span<double> out) const {
        detail::check(
            urdd_robot_jacobians(handle_.get(), q.data(), 1, q.size(), link, point.data(), out.data(), out.size()));
    }

    /// Searches a configuration within the bounds in which a link has a pose. Checks for collisions where `free_of` of
    /// the settings is set, to the `handle()` of a `Proximity`.
    Inverse inverse_kinematics(std::size_t link, const Pose &pose, Span<const double> start,
                               const urdd_inverse_settings &settings = inverse_settings()) const {
        urdd_target target{};
        target.link = link;
        for (std::size_t k = 0; k < 16; ++k)
            target.pose[k] = pose[k];
        return inverse_kinematics(target, start, settings);
    }
    /// As above, for a target that can also be a position, or of another point of the link.
    Inverse inverse_kinematics(const urdd_target &target, Span<const double> start,
                               const urdd_inverse_settings &settings = inverse_settings()) const {
        Inverse found{std::vector<double>(start.size()), {}};
        detail::check(urdd_robot_inverse_kinematics(handle_.get(), &target, 1, start.data(), 1, start.size(), &settings,
                                                    found.configuration.data(), &found.solution));
        return found;
    }

    /// Prepares the shapes of a kind for distances.
    Proximity proximity(ShapeKind kind = ShapeKind::pieces) const {
        return Proximity(detail::made<urdd_proximity>(
            [&](urdd_proximity **out) { return urdd_robot_proximity(handle_.get(), name(kind), out); }));
    }
    /// Reads the learned self-collision model.
    CollisionModel collision_model() const {
        return CollisionModel(detail::made<urdd_collision_model>(
            [&](urdd_collision_model **out) { return urdd_robot_collision_model(handle_.get(), out); }));
    }
    /// Reads the skips between the shapes of a kind.
    Skips skips(ShapeKind kind = ShapeKind::pieces) const {
        return Skips(detail::made<urdd_skips>(
            [&](urdd_skips **out) { return urdd_robot_skips(handle_.get(), name(kind), out); }));
    }

    const urdd_robot *handle() const noexcept { return handle_.get(); }

private:
    explicit Robot(urdd_robot *handle) : handle_(handle) {}
    std::array<std::size_t, 3> sizes() const {
        std::array<std::size_t, 3> found{};
        detail::check(urdd_robot_sizes(handle_.get(), &found[0], &found[1], &found[2]));
        return found;
    }
    std::vector<std::string> names(std::size_t count,
                                   urdd_status (*name)(const urdd_robot *, std::size_t, urdd_text *)) const {
        std::vector<std::string> found;
        found.reserve(count);
        for (std::size_t k = 0; k < count; ++k) {
            urdd_text text{};
            detail::check(name(handle_.get(), k, &text));
            found.push_back(detail::string(text));
        }
        return found;
    }
    std::vector<double> configuration(urdd_status (*of)(const urdd_robot *, double *, std::size_t)) const {
        std::vector<double> found(num_dofs());
        detail::check(of(handle_.get(), found.data(), found.size()));
        return found;
    }
    detail::Handle<urdd_robot, urdd_robot_free> handle_;
};

} // namespace urdd

#endif
