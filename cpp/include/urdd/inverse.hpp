// Inverse kinematics: targets, settings, results.

#ifndef URDD_INVERSE_HPP
#define URDD_INVERSE_HPP

#include <optional>

#include "proximity.hpp"

namespace urdd {

/// A target of inverse kinematics. Members are those of `urdd_target`: `point` is a tool tip, `weights` leave
/// directions free.
struct Target : urdd_target {
    /// A pose that a link is to have, in the root link's frame.
    Target(std::size_t of_link, const Pose &of_pose, const Point &of_point = {0, 0, 0}) : urdd_target{} {
        link = of_link;
        for (std::size_t k = 0; k < 16; ++k)
            pose[k] = of_pose[k];
        for (std::size_t k = 0; k < 3; ++k)
            point[k] = of_point[k];
    }
    /// A position of a point of a link: the link's rotation is free.
    static Target position(std::size_t link, const Point &at, const Point &point = {0, 0, 0}) {
        Target found(link, translation(at[0], at[1], at[2]), point);
        found.is_position = true;
        return found;
    }
};
static_assert(sizeof(Target) == sizeof(urdd_target), "an array of targets is one of urdd_target");

/// Settings of inverse kinematics, with the defaults of the library. They own what they name.
struct InverseSettings {
    /// Tolerances, metres and radians.
    double position_tolerance = defaults().position_tolerance;
    double rotation_tolerance = defaults().rotation_tolerance;
    /// The most iterations of a descent, and descents from random configurations after the first.
    std::size_t iterations = defaults().iterations;
    std::size_t restarts = defaults().restarts;
    /// Of the random configurations: the search is deterministic.
    std::uint64_t seed = defaults().seed;
    /// A lower and an upper bound of each DOF in place of the robot's, rad or m; or empty.
    std::vector<std::array<double, 2>> bounds{};
    /// DOFs that keep the value of the start.
    std::vector<std::size_t> locked{};
    /// A configuration that the solution should be near; or empty.
    std::vector<double> posture{};
    /// Shapes that must not touch one another in a solution.
    std::optional<Proximity> free_of{};
    /// Obstacles that a solution must not touch, and the distance that it keeps from them, metres.
    std::optional<WorldProximity> free_of_world{};
    double margin = defaults().margin;
    /// Whether to find out why a target is not reached, which takes as long as the search.
    bool explain = defaults().explain;
    /// Whether the kinematic loops of the robot may be open in a solution; otherwise it is closed.
    bool open_loops = defaults().open_loops;

    /// For C: alive as long as this.
    urdd_inverse_settings raw() const & {
        urdd_inverse_settings found = defaults();
        found.position_tolerance = position_tolerance;
        found.rotation_tolerance = rotation_tolerance;
        found.iterations = iterations;
        found.restarts = restarts;
        found.seed = seed;
        found.bounds = bounds.empty() ? nullptr : bounds.data()->data();
        found.bounds_length = 2 * bounds.size();
        found.locked = locked.empty() ? nullptr : locked.data();
        found.locked_length = locked.size();
        found.posture = posture.empty() ? nullptr : posture.data();
        found.posture_length = posture.size();
        found.free_of = free_of ? free_of->handle() : nullptr;
        found.free_of_world = free_of_world ? free_of_world->handle() : nullptr;
        found.margin = margin;
        found.explain = explain;
        found.open_loops = open_loops;
        return found;
    }
    urdd_inverse_settings raw() const && = delete;

private:
    static urdd_inverse_settings defaults() {
        urdd_inverse_settings found{};
        detail::check(urdd_inverse_settings_default(&found));
        return found;
    }
};

/// What inverse kinematics found: the configuration, and how near it comes.
struct Inverse {
    std::vector<double> configuration;
    urdd_inverse_solution solution;

    bool is_reached() const noexcept { return solution.is_reached; }
};

} // namespace urdd

#endif
