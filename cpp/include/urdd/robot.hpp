// A robot.

#ifndef URDD_ROBOT_HPP
#define URDD_ROBOT_HPP

#include "collision_model.hpp"
#include "inverse.hpp"
#include "proximity.hpp"
#include "spheres.hpp"

namespace urdd {

/// A mass that a link carries: kg, and its centre in the link's frame. A mass of 0 is no payload.
struct Payload {
    double mass = 0;
    std::size_t link = 0;
    Point point = {0, 0, 0};
};

/// How far a loop is from closed.
struct Gap {
    double position; ///< m
    double rotation; ///< rad, while small
};
static_assert(sizeof(Gap) == 2 * sizeof(double), "an array of gaps is one of numbers");

/// How far a configuration is from closed.
struct LoopErrors {
    /// For each loop.
    std::vector<Gap> gaps;
    /// For each coupling between DOFs: 0 where it holds.
    std::vector<double> sums;
    /// Whether all loops are closed and all couplings hold, within their tolerances.
    bool is_closed = false;
};

/// The closed configuration near another one.
struct Closed {
    /// Closed, or with the smallest gaps that were found.
    std::vector<double> configuration;
    bool is_closed = false;
};

/// Those near many: rows x dofs.
struct ClosedBatch {
    std::vector<double> configurations;
    std::vector<bool> is_closed;
};

/// A robot, as its URDD describes it.
class Robot {
public:
    /// Opens the URDD in a folder or zip archive. Reads no module yet.
    static Robot open(const std::string &path) {
        return Robot(
            detail::made<urdd_robot>([&](urdd_robot **out) { return urdd_robot_open(detail::c_text(path), out); }));
    }
    /// Opens the URDD in a zip archive in memory, which is copied. `name` stands for it in messages.
    static Robot of_archive(const std::string &name, Argument<const std::uint8_t> bytes) {
        return Robot(detail::made<urdd_robot>([&](urdd_robot **out) {
            return urdd_robot_of_archive(detail::c_text(name), bytes.data(), bytes.size(), out);
        }));
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
        detail::check(urdd_robot_link(handle_.get(), detail::c_text(name), &found));
        return found;
    }
    /// The index of a joint.
    std::size_t joint(const std::string &name) const {
        std::size_t found = 0;
        detail::check(urdd_robot_joint(handle_.get(), detail::c_text(name), &found));
        return found;
    }
    /// The DOFs that move one of two links against the other, ascending: those of an arm, from its base and its tip.
    std::vector<std::size_t> dofs_between(std::size_t base, std::size_t tip) const {
        std::vector<std::size_t> found(num_dofs());
        std::size_t count = 0;
        detail::check(urdd_robot_dofs_between(handle_.get(), base, tip, found.data(), found.size(), &count));
        found.resize(count);
        return found;
    }
    /// The index of a DOF.
    std::size_t dof(const std::string &name) const {
        std::size_t found = 0;
        detail::check(urdd_robot_dof(handle_.get(), detail::c_text(name), &found));
        return found;
    }

    /// The lower and the upper bound of each DOF, rad or m.
    std::vector<std::array<double, 2>> bounds() const {
        std::vector<std::array<double, 2>> found(num_dofs());
        double *values = found.empty() ? nullptr : found.data()->data();
        detail::check(urdd_robot_bounds(handle_.get(), values, 2 * found.size()));
        return found;
    }
    /// Whether the source limits each DOF. The bounds of others are a range to sample from, which they may leave.
    std::vector<bool> dof_is_limited() const {
        const std::size_t dofs = num_dofs();
        auto found = std::make_unique<bool[]>(dofs);
        detail::check(urdd_robot_dof_is_limited(handle_.get(), found.get(), dofs));
        return detail::answers(found, dofs);
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
    void clamp(Argument<double> q) const { detail::check(urdd_robot_clamp(handle_.get(), q.data(), q.size())); }
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
    Point centre_of_mass(Argument<const double> q) const {
        Point found{};
        detail::check(urdd_robot_centre_of_mass(handle_.get(), q.data(), 1, q.size(), found.data()));
        return found;
    }
    /// The torque (N m) or force (N) of each DOF that holds the robot still against gravity: what the motors must give,
    /// positive where the DOF must push toward larger values. `gravity` is in the root link's frame, m/s^2.
    std::vector<double> gravity_torques(Argument<const double> q, const Payload &payload = {},
                                        const Point &gravity = {0, 0, -9.81}) const {
        return gravity_torques_batch({q.data(), 1, q.size()}, payload, gravity);
    }
    /// The same in each configuration, one after another: rows x dofs.
    std::vector<double> gravity_torques_batch(Rows q, const Payload &payload = {},
                                              const Point &gravity = {0, 0, -9.81}) const {
        std::vector<double> found(q.rows * q.columns);
        gravity_torques(q, payload, gravity, found);
        return found;
    }
    /// As above, into `out`: rows x dofs.
    void gravity_torques(Rows q, const Payload &payload, const Point &gravity, Argument<double> out) const {
        detail::check(urdd_robot_gravity_torques(handle_.get(), q.data, q.rows, q.columns, gravity.data(), payload.mass,
                                                 payload.link, payload.point.data(), out.data(), out.size()));
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
        detail::check(urdd_robot_named_configuration(handle_.get(), detail::c_text(name), found.data(), found.size()));
        return found;
    }

    /// The pose of each link.
    Poses link_poses(Argument<const double> q) const { return link_poses_batch({q.data(), 1, q.size()}); }
    /// The poses of all links in each configuration: rows x links.
    Poses link_poses_batch(Rows q) const {
        Poses found(q.rows * num_links());
        link_poses(q, found);
        return found;
    }
    /// As above, into `out`: rows x links.
    void link_poses(Rows q, Argument<Pose> out) const {
        double *values = out.size() == 0 ? nullptr : out.data()->data();
        detail::check(urdd_robot_link_poses(handle_.get(), q.data, q.rows, q.columns, values, 16 * out.size()));
    }
    /// The geometric Jacobian of a point of a link, in the link's frame: 6 x dofs, column-major. Linear, then angular
    /// velocity, in the root link's frame.
    std::vector<double> jacobian(Argument<const double> q, std::size_t link, const Point &point = {0, 0, 0}) const {
        return jacobian_batch({q.data(), 1, q.size()}, link, point);
    }
    /// As above, into `out`.
    void jacobian(Argument<const double> q, std::size_t link, const Point &point, Argument<double> out) const {
        jacobian({q.data(), 1, q.size()}, link, point, out);
    }
    /// The Jacobians in each configuration, one after another.
    std::vector<double> jacobian_batch(Rows q, std::size_t link, const Point &point = {0, 0, 0}) const {
        std::vector<double> found(6 * q.rows * q.columns);
        jacobian(q, link, point, found);
        return found;
    }
    /// As above, into `out`: rows x dofs x 6.
    void jacobian(Rows q, std::size_t link, const Point &point, Argument<double> out) const {
        detail::check(
            urdd_robot_jacobians(handle_.get(), q.data, q.rows, q.columns, link, point.data(), out.data(), out.size()));
    }

    /// Searches a configuration within the bounds that reaches a target: by damped least squares from `start`, then
    /// from random configurations.
    Inverse inverse_kinematics(const Target &target, Argument<const double> start,
                               const InverseSettings &settings = {}) const {
        Inverse found{std::vector<double>(start.size()), {}};
        inverse_kinematics({&target, 1}, {start.data(), 1, start.size()}, settings, found.configuration,
                           {&found.solution, 1});
        return found;
    }
    /// As above, for a pose of a link.
    Inverse inverse_kinematics(std::size_t link, const Pose &pose, Argument<const double> start,
                               const InverseSettings &settings = {}) const {
        return inverse_kinematics(Target(link, pose), start, settings);
    }
    /// Many targets, from one start or one for each, on all processors.
    std::vector<Inverse> inverse_kinematics_batch(Argument<const Target> targets, Rows starts,
                                                  const InverseSettings &settings = {}) const {
        const std::size_t count = targets.size(), dofs = starts.columns;
        std::vector<double> configurations(count * dofs);
        std::vector<urdd_inverse_solution> solutions(count);
        inverse_kinematics(targets, starts, settings, configurations, solutions);
        std::vector<Inverse> found;
        found.reserve(count);
        for (std::size_t k = 0; k < count; ++k) {
            const auto first = configurations.begin() + static_cast<std::ptrdiff_t>(k * dofs);
            found.push_back({{first, first + static_cast<std::ptrdiff_t>(dofs)}, solutions[k]});
        }
        return found;
    }
    /// As above, into `configurations`, targets x dofs, and `solutions`, one for each target.
    void inverse_kinematics(Argument<const Target> targets, Rows starts, const InverseSettings &settings,
                            Argument<double> configurations, Argument<urdd_inverse_solution> solutions) const {
        const urdd_inverse_settings raw = settings.raw();
        detail::same_size("configurations", configurations.size(), targets.size() * starts.columns);
        detail::same_size("solutions", solutions.size(), targets.size());
        detail::check(urdd_robot_inverse_kinematics(handle_.get(), targets.data(), targets.size(), starts.data,
                                                    starts.rows, starts.columns, &raw, configurations.data(),
                                                    solutions.data()));
    }

    /// The names of the loops, in the order of `loop_errors`. A robot without loops is a tree: it has no equations,
    /// every configuration is closed, and all DOFs move freely.
    std::vector<std::string> loop_names() const { return names(loop_sizes()[0], urdd_robot_loop_name); }
    /// The names of the couplings between DOFs.
    std::vector<std::string> coupling_names() const { return names(loop_sizes()[1], urdd_robot_coupling_name); }
    std::size_t num_loop_equations() const { return loop_sizes()[2]; }
    /// A configuration in which all loops are closed, to begin with; for a tree, the default one.
    std::vector<double> reference_configuration() const { return configuration(urdd_robot_reference_configuration); }
    /// How far a configuration is from closed.
    LoopErrors loop_errors(Argument<const double> q) const {
        const std::array<std::size_t, 4> sizes = loop_sizes();
        LoopErrors found{std::vector<Gap>(sizes[0]), std::vector<double>(sizes[1]), false};
        double *gaps = found.gaps.empty() ? nullptr : &found.gaps.data()->position;
        detail::check(urdd_robot_loop_errors(handle_.get(), q.data(), 1, q.size(), gaps, 2 * found.gaps.size(),
                                             found.sums.data(), found.sums.size(), &found.is_closed));
        return found;
    }
    /// The closed configuration near another one, within the bounds: start near what is wanted, such as from the last
    /// configuration of a motion. `held` DOFs keep their value. `bounds` are a lower and an upper one for each DOF in
    /// place of the robot's, which may be infinite; or empty.
    Closed close(Argument<const double> q, const std::vector<std::size_t> &held = {},
                 const std::vector<std::array<double, 2>> &bounds = {}) const {
        Closed found{std::vector<double>(q.size()), false};
        close({q.data(), 1, q.size()}, held, bounds, found.configuration, {&found.is_closed, 1});
        return found;
    }
    /// Those near many, on all processors.
    ClosedBatch close_batch(Rows q, const std::vector<std::size_t> &held = {},
                            const std::vector<std::array<double, 2>> &bounds = {}) const {
        ClosedBatch found{std::vector<double>(q.rows * q.columns), {}};
        auto closed = std::make_unique<bool[]>(q.rows);
        close(q, held, bounds, found.configurations, {closed.get(), q.rows});
        found.is_closed = detail::answers(closed, q.rows);
        return found;
    }
    /// As above, into `found`, rows x dofs, and `closed`, one for each row. One row needs no allocation.
    void close(Rows q, const std::vector<std::size_t> &held, const std::vector<std::array<double, 2>> &bounds,
               Argument<double> found, Argument<bool> closed) const {
        detail::same_size("found", found.size(), q.rows * q.columns);
        detail::same_size("closed", closed.size(), q.rows);
        const double *values = bounds.empty() ? nullptr : bounds.data()->data();
        detail::check(urdd_robot_close(handle_.get(), q.data, q.rows, q.columns, held.data(), held.size(), values,
                                       2 * bounds.size(), found.data(), closed.data()));
    }
    /// The DOFs that move freely, ascending, as the URDD states them; the others follow from them near the reference
    /// configuration.
    std::vector<std::size_t> independent_dofs() const {
        std::vector<std::size_t> found(loop_sizes()[3]);
        detail::check(urdd_robot_independent_dofs(handle_.get(), found.data(), found.size()));
        return found;
    }
    /// Whether each DOF moves freely in a closed configuration.
    std::vector<bool> free_dofs(Argument<const double> q) const {
        auto found = std::make_unique<bool[]>(q.size());
        detail::check(urdd_robot_free_dofs(handle_.get(), q.data(), q.size(), found.get()));
        return detail::answers(found, q.size());
    }
    /// The left-hand sides of the equations, which are 0 where they hold: for each loop those of its kind, m, then rad,
    /// then the sum of each coupling.
    std::vector<double> loop_residuals(Argument<const double> q) const {
        std::vector<double> found(num_loop_equations());
        detail::check(urdd_robot_loop_residuals(handle_.get(), q.data(), 1, q.size(), found.data(), found.size()));
        return found;
    }
    /// Their derivatives by each DOF: equations x dofs, column-major.
    std::vector<double> loop_jacobian(Argument<const double> q) const {
        std::vector<double> found(num_loop_equations() * q.size());
        detail::check(urdd_robot_loop_jacobians(handle_.get(), q.data(), 1, q.size(), found.data(), found.size()));
        return found;
    }
    /// The velocities of all DOFs, rad/s or m/s, that keep the loops closed, for those of the independent DOFs, in
    /// their order; nothing where the others do not follow from these.
    std::optional<std::vector<double>> loop_velocities(Argument<const double> q,
                                                       Argument<const double> independent) const {
        std::vector<double> found(q.size());
        detail::check(urdd_robot_loop_velocities(handle_.get(), q.data(), 1, q.size(), independent.data(),
                                                 independent.size(), found.data()));
        for (const double velocity : found) {
            if (velocity != velocity) {
                return std::nullopt;
            }
        }
        return found;
    }

    /// Prepares the shapes of a kind for distances.
    Proximity proximity(ShapeKind kind = ShapeKind::pieces) const {
        return Proximity(detail::made<urdd_proximity>(
            [&](urdd_proximity **out) { return urdd_robot_proximity(handle_.get(), name(kind), out); }));
    }
    /// Prepares the finest level of spheres that covers the links, as the URDD has them, for its pairs of links.
    CoveringChecker covering_checker() const {
        return CoveringChecker(detail::made<urdd_covering_checker>(
            [&](urdd_covering_checker **out) { return urdd_robot_covering_checker(handle_.get(), out); }));
    }
    /// The same of spheres that you have, which cover the shapes, for these pairs of links.
    CoveringChecker covering_checker(Argument<const LinkSphere> spheres, Argument<const LinkPair> pairs) const {
        return CoveringChecker(detail::made<urdd_covering_checker>([&](urdd_covering_checker **out) {
            return urdd_robot_covering_checker_of(handle_.get(), spheres.data(), spheres.size(), pairs.data(),
                                                  pairs.size(), out);
        }));
    }
    /// Prepares the last level of spheres that does not cover the links: fitted ones, or those that a person gave.
    ApproximatingChecker approximating_checker() const {
        return ApproximatingChecker(detail::made<urdd_approximating_checker>(
            [&](urdd_approximating_checker **out) { return urdd_robot_approximating_checker(handle_.get(), out); }));
    }
    /// The same of spheres that you have, for these pairs of links.
    ApproximatingChecker approximating_checker(Argument<const LinkSphere> spheres,
                                               Argument<const LinkPair> pairs) const {
        return ApproximatingChecker(detail::made<urdd_approximating_checker>([&](urdd_approximating_checker **out) {
            return urdd_robot_approximating_checker_of(handle_.get(), spheres.data(), spheres.size(), pairs.data(),
                                                       pairs.size(), out);
        }));
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

    const urdd_robot *handle() const & noexcept { return handle_.get(); }
    const urdd_robot *handle() const && = delete; // it would be freed at once

private:
    explicit Robot(urdd_robot *handle) : handle_(handle) {}
    std::array<std::size_t, 3> sizes() const {
        std::array<std::size_t, 3> found{};
        detail::check(urdd_robot_sizes(handle_.get(), &found[0], &found[1], &found[2]));
        return found;
    }
    std::array<std::size_t, 4> loop_sizes() const {
        std::array<std::size_t, 4> found{};
        detail::check(urdd_robot_loop_sizes(handle_.get(), &found[0], &found[1], &found[2], &found[3]));
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
