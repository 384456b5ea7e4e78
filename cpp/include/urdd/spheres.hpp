// Spheres in the place of a robot's shapes.

#ifndef URDD_SPHERES_HPP
#define URDD_SPHERES_HPP

#include "proximity.hpp"

namespace urdd {

/// What covering spheres say. It is no `bool`: where it may collide, ask the shapes.
enum class CoveringAnswer {
    maybe = URDD_COVERING_ANSWER_MAYBE, ///< Spheres touch; the shapes may.
    free = URDD_COVERING_ANSWER_FREE,   ///< Certainly no contact.
};

/// What approximating spheres say.
enum class ApproximateAnswer {
    contact = URDD_APPROXIMATE_ANSWER_CONTACT, ///< Spheres touch; the shapes may be apart.
    free = URDD_APPROXIMATE_ANSWER_FREE,       ///< No spheres touch; parts of shapes outside of them may.
};

/// A sphere of a link, in the link's frame, metres: `level`, from 0, the coarsest, on; `link`; `centre`; `radius`.
using LinkSphere = urdd_link_sphere;
/// Two links that are checked against each other: `links`.
using LinkPair = urdd_link_pair;

namespace detail {

struct OfCovering {
    using Raw = urdd_covering_checker;
    using Handle = detail::Handle<urdd_covering_checker, urdd_covering_checker_free>;
    using Answer = CoveringAnswer;
    using RawAnswer = urdd_covering_answer;
    static constexpr auto num_dofs = urdd_covering_checker_num_dofs;
    static constexpr auto around = urdd_covering_checker_around;
    static constexpr auto move_obstacles = urdd_covering_checker_move_obstacles;
    static constexpr auto is_within = urdd_covering_checker_is_within;
    static constexpr auto blocked_edge = urdd_covering_checker_blocked_edge;
    static constexpr auto first_contact = urdd_covering_checker_first_contact;
};

struct OfApproximating {
    using Raw = urdd_approximating_checker;
    using Handle = detail::Handle<urdd_approximating_checker, urdd_approximating_checker_free>;
    using Answer = ApproximateAnswer;
    using RawAnswer = urdd_approximate_answer;
    static constexpr auto num_dofs = urdd_approximating_checker_num_dofs;
    static constexpr auto around = urdd_approximating_checker_around;
    static constexpr auto move_obstacles = urdd_approximating_checker_move_obstacles;
    static constexpr auto is_within = urdd_approximating_checker_is_within;
    static constexpr auto blocked_edge = urdd_approximating_checker_blocked_edge;
    static constexpr auto first_contact = urdd_approximating_checker_first_contact;
};

} // namespace detail

/// The spheres of a robot, prepared for yes or no: whether any touch, in configurations and along straight motions.
/// Eight configurations are checked at once. Made by `Robot::covering_checker` and `Robot::approximating_checker`.
/// Values of a configuration are at most 1e9.
template <typename Of> class SphereChecker {
public:
    using Answer = typename Of::Answer;

    std::size_t num_dofs() const {
        std::size_t found = 0;
        detail::check(Of::num_dofs(handle(), &found));
        return found;
    }
    /// The same spheres among obstacles, which are copied: each query then asks for both. Those of this checker are not
    /// kept.
    SphereChecker around(std::initializer_list<Obstacle> obstacles) const {
        return around(Span<const Obstacle>(obstacles.begin(), obstacles.size()));
    }
    SphereChecker around(Argument<const Obstacle> obstacles) const {
        const std::vector<const urdd_obstacle *> handles = detail::handles(obstacles);
        return SphereChecker(detail::made<typename Of::Raw>(
            [&](typename Of::Raw **out) { return Of::around(handle(), handles.data(), handles.size(), out); }));
    }
    /// Moves the obstacles from index `first` on to other poses, without preparing anything again. Copies of this
    /// object share the obstacles; no other thread uses them during the call.
    void move_obstacles(std::size_t first, Argument<const Pose> poses) {
        const double *values = poses.size() == 0 ? nullptr : poses.data()->data();
        detail::check(Of::move_obstacles(handle_.get(), first, values, poses.size()));
    }
    /// What the spheres say of a configuration.
    Answer in_collision(Argument<const double> q) const { return is_within(q, 0.0); }
    std::vector<Answer> in_collision_batch(Rows q) const { return is_within_batch(q, 0.0); }
    /// As `in_collision`, of spheres that are at most `margin` apart, metres.
    Answer is_within(Argument<const double> q, double margin) const {
        typename Of::RawAnswer found{};
        detail::check(Of::is_within(handle(), q.data(), 1, q.size(), margin, &found));
        return static_cast<Answer>(found);
    }
    std::vector<Answer> is_within_batch(Rows q, double margin) const {
        std::vector<typename Of::RawAnswer> found(q.rows);
        detail::check(Of::is_within(handle(), q.data, q.rows, q.columns, margin, found.data()));
        std::vector<Answer> answers;
        answers.reserve(found.size());
        for (const typename Of::RawAnswer answer : found)
            answers.push_back(static_cast<Answer>(answer));
        return answers;
    }
    /// Where spheres touch on the straight motion from `start` to `end`, as a part of it from 0 to 1; NaN if they do
    /// not. Configurations are checked between which no point of a sphere travels farther than `resolution`, metres,
    /// spread over the whole motion: the answer need not be the first part, which `first_contact` has. For a robot with
    /// kinematic loops, `open_loops` is needed: spheres follow no motion in which they stay closed.
    double blocked_edge(Argument<const double> start, Argument<const double> end, double margin = 0.0,
                        double resolution = 0.01, bool open_loops = false) const {
        double found = 0;
        blocked_edge({start.data(), 1, start.size()}, {end.data(), 1, end.size()}, margin, resolution, open_loops,
                     {&found, 1});
        return found;
    }
    std::vector<double> blocked_edge_batch(Rows starts, Rows ends, double margin = 0.0, double resolution = 0.01,
                                           bool open_loops = false) const {
        std::vector<double> found(starts.rows);
        blocked_edge(starts, ends, margin, resolution, open_loops, found);
        return found;
    }
    /// As above, into `out`.
    void blocked_edge(Rows starts, Rows ends, double margin, double resolution, bool open_loops,
                      Argument<double> out) const {
        detail::same_shape(starts, ends);
        detail::same_size("out", out.size(), starts.rows);
        detail::check(Of::blocked_edge(handle(), starts.data, ends.data, starts.rows, starts.columns, margin,
                                       resolution, open_loops, out.data()));
    }
    /// As `blocked_edge`, where spheres touch first, and how far they are free. The part between two configurations is
    /// divided by 4096.
    FirstContact first_contact(Argument<const double> start, Argument<const double> end, double margin = 0.0,
                               double resolution = 0.01, bool open_loops = false) const {
        FirstContact found{};
        first_contact({start.data(), 1, start.size()}, {end.data(), 1, end.size()}, margin, resolution, open_loops,
                      {&found, 1});
        return found;
    }
    std::vector<FirstContact> first_contact_batch(Rows starts, Rows ends, double margin = 0.0, double resolution = 0.01,
                                                  bool open_loops = false) const {
        std::vector<FirstContact> found(starts.rows);
        first_contact(starts, ends, margin, resolution, open_loops, found);
        return found;
    }
    /// As above, into `out`.
    void first_contact(Rows starts, Rows ends, double margin, double resolution, bool open_loops,
                       Argument<FirstContact> out) const {
        detail::same_shape(starts, ends);
        double *values = out.size() == 0 ? nullptr : &out.data()->free;
        detail::check(Of::first_contact(handle(), starts.data, ends.data, starts.rows, starts.columns, margin,
                                        resolution, open_loops, values, 2 * out.size()));
    }

    auto handle() const & noexcept { return handle_.get(); }
    auto handle() const && = delete; // it would be freed at once

private:
    friend class Robot;
    explicit SphereChecker(typename Of::Raw *handle) : handle_(handle) {}
    typename Of::Handle handle_;
};

/// Spheres that contain the shapes: where none touch, the robot is certainly free.
using CoveringChecker = SphereChecker<detail::OfCovering>;
/// Spheres that are near the shapes: nothing is certain.
using ApproximatingChecker = SphereChecker<detail::OfApproximating>;

} // namespace urdd

#endif
