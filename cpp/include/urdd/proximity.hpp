// Distances and collisions, of a robot with itself and with obstacles.

#ifndef URDD_PROXIMITY_HPP
#define URDD_PROXIMITY_HPP

#include "obstacle.hpp"

namespace urdd {

/// The nearest pairs, and the gradients of their distances, m/rad or m/m: a row of `values` for each pair.
template <typename Pair> struct Gradients {
    std::vector<Pair> pairs;
    std::vector<double> values;
};

/// How far a straight motion is free, as parts of it from 0 to 1: the last part that is known to be free (0 if the
/// start is not), and the first that is not. Both are NaN where the motion is free.
struct FirstContact {
    double free;
    double blocked;
    bool is_blocked() const noexcept { return blocked == blocked; }
};
static_assert(sizeof(FirstContact) == 2 * sizeof(double), "an array of contacts is one of numbers");

namespace detail {

struct OfRobot {
    using Handle = detail::Handle<urdd_proximity, urdd_proximity_free>;
    using Shapes = urdd_pair;
    using Pair = urdd_pair_distance;
    using Overlap = urdd_overlap;
    static constexpr auto pairs = urdd_proximity_pairs;
    static constexpr auto in_collision = urdd_proximity_in_collision;
    static constexpr auto distances = urdd_proximity_distances;
    static constexpr auto nearest = urdd_proximity_nearest;
    static constexpr auto is_within = urdd_proximity_is_within;
    static constexpr auto blocked_edge = urdd_proximity_blocked_edge;
    static constexpr auto first_contact = urdd_proximity_first_contact;
    static constexpr auto motions = urdd_proximity_motions;
    static constexpr auto gradients = urdd_proximity_gradients;
    static constexpr auto penetrations = urdd_proximity_penetrations;
    static urdd_status num_pairs(const urdd_proximity *handle, std::size_t *out) {
        return urdd_proximity_sizes(handle, nullptr, out, nullptr);
    }
};

struct OfWorld {
    using Handle = detail::Handle<urdd_world_proximity, urdd_world_proximity_free>;
    using Shapes = urdd_obstacle_pair;
    using Pair = urdd_obstacle_distance;
    using Overlap = urdd_obstacle_overlap;
    static constexpr auto pairs = urdd_world_proximity_pairs;
    static constexpr auto in_collision = urdd_world_proximity_in_collision;
    static constexpr auto distances = urdd_world_proximity_distances;
    static constexpr auto nearest = urdd_world_proximity_nearest;
    static constexpr auto is_within = urdd_world_proximity_is_within;
    static constexpr auto blocked_edge = urdd_world_proximity_blocked_edge;
    static constexpr auto first_contact = urdd_world_proximity_first_contact;
    static constexpr auto motions = urdd_world_proximity_motions;
    static constexpr auto gradients = urdd_world_proximity_gradients;
    static constexpr auto penetrations = urdd_world_proximity_penetrations;
    static urdd_status num_pairs(const urdd_world_proximity *handle, std::size_t *out) {
        return urdd_world_proximity_sizes(handle, out, nullptr, nullptr);
    }
};

} // namespace detail

/// What is asked of a robot's own pairs, and of the pairs of a shape of the robot and a convex part of an obstacle.
template <typename Of> class Queries {
public:
    std::size_t num_pairs() const {
        std::size_t found = 0;
        detail::check(Of::num_pairs(handle(), &found));
        return found;
    }
    /// The pairs that are checked, in the order of `distances`.
    std::vector<typename Of::Shapes> pairs() const {
        std::vector<typename Of::Shapes> found(num_pairs());
        detail::check(Of::pairs(handle(), found.data(), found.size()));
        return found;
    }
    /// The distance of each pair, metres.
    std::vector<double> distances(Argument<const double> q) const { return distances_batch({q.data(), 1, q.size()}); }
    /// As above, into `out`: rows x pairs.
    void distances(Rows q, Argument<double> out) const {
        detail::check(Of::distances(handle(), q.data, q.rows, q.columns, out.data(), out.size()));
    }
    std::vector<double> distances_batch(Rows q) const {
        std::vector<double> found(q.rows * num_pairs());
        distances(q, found);
        return found;
    }
    /// Whether any pair touches or overlaps.
    bool in_collision(Argument<const double> q) const {
        bool found = false;
        detail::check(Of::in_collision(handle(), q.data(), 1, q.size(), &found));
        return found;
    }
    std::vector<bool> in_collision_batch(Rows q) const {
        auto found = std::make_unique<bool[]>(q.rows);
        detail::check(Of::in_collision(handle(), q.data, q.rows, q.columns, found.get()));
        return detail::answers(found, q.rows);
    }
    /// The `k` nearest pairs, nearest first, with their closest points.
    std::vector<typename Of::Pair> nearest(Argument<const double> q, std::size_t k) const {
        std::vector<typename Of::Pair> found(k);
        found.resize(nearest(q, found));
        return found;
    }
    /// As above, as many as there is room for in `out`; returns how many there are.
    std::size_t nearest(Argument<const double> q, Argument<typename Of::Pair> out) const {
        std::size_t count = 0;
        detail::check(Of::nearest(handle(), q.data(), 1, q.size(), out.size(), out.data(), &count));
        return count;
    }
    /// Whether any pair is at most `margin` apart, metres. It stops at the first such pair.
    bool is_within(Argument<const double> q, double margin) const {
        bool found = false;
        detail::check(Of::is_within(handle(), q.data(), 1, q.size(), margin, &found));
        return found;
    }
    std::vector<bool> is_within_batch(Rows q, double margin) const {
        auto found = std::make_unique<bool[]>(q.rows);
        detail::check(Of::is_within(handle(), q.data, q.rows, q.columns, margin, found.get()));
        return detail::answers(found, q.rows);
    }
    /// Where the straight motion from `start` to `end` is blocked, as a part of it from 0 to 1; NaN if it is free. With
    /// a `resolution` above 0, metres, configurations are checked between which no point of the robot travels farther,
    /// the halves first: the answer need not be the first blocked place, which `first_contact` has. With 0, the motion
    /// is proved free, which needs 0.1 mm more than the margin.
    double blocked_edge(Argument<const double> start, Argument<const double> end, double margin = 0.0,
                        double resolution = 0.01) const {
        double found = 0;
        blocked_edge({start.data(), 1, start.size()}, {end.data(), 1, end.size()}, margin, resolution, {&found, 1});
        return found;
    }
    std::vector<double> blocked_edge_batch(Rows starts, Rows ends, double margin = 0.0,
                                           double resolution = 0.01) const {
        std::vector<double> found(starts.rows);
        blocked_edge(starts, ends, margin, resolution, found);
        return found;
    }
    /// As above, into `out`.
    void blocked_edge(Rows starts, Rows ends, double margin, double resolution, Argument<double> out) const {
        detail::same_shape(starts, ends);
        detail::same_size("out", out.size(), starts.rows);
        detail::check(Of::blocked_edge(handle(), starts.data, ends.data, starts.rows, starts.columns, margin,
                                       resolution, out.data()));
    }
    /// As `blocked_edge`, where it is blocked first, and how far it is free.
    FirstContact first_contact(Argument<const double> start, Argument<const double> end, double margin = 0.0,
                               double resolution = 0.01) const {
        FirstContact found{};
        first_contact({start.data(), 1, start.size()}, {end.data(), 1, end.size()}, margin, resolution, {&found, 1});
        return found;
    }
    std::vector<FirstContact> first_contact_batch(Rows starts, Rows ends, double margin = 0.0,
                                                  double resolution = 0.01) const {
        std::vector<FirstContact> found(starts.rows);
        first_contact(starts, ends, margin, resolution, found);
        return found;
    }
    /// As above, into `out`.
    void first_contact(Rows starts, Rows ends, double margin, double resolution, Argument<FirstContact> out) const {
        detail::same_shape(starts, ends);
        double *values = out.size() == 0 ? nullptr : &out.data()->free;
        detail::check(Of::first_contact(handle(), starts.data, ends.data, starts.rows, starts.columns, margin,
                                        resolution, values, 2 * out.size()));
    }
    /// As `first_contact`, with why the motion cannot go on. Where the robot has kinematic loops, they stay closed,
    /// unless `open_loops` asks for the straight motion of the spanning tree.
    urdd_motion motion(Argument<const double> start, Argument<const double> end, double margin = 0.0,
                       double resolution = 0.01, bool open_loops = false) const {
        urdd_motion found{};
        motions({start.data(), 1, start.size()}, {end.data(), 1, end.size()}, margin, resolution, open_loops,
                {&found, 1});
        return found;
    }
    /// The same for many motions, into `out`.
    void motions(Rows starts, Rows ends, double margin, double resolution, bool open_loops,
                 Argument<urdd_motion> out) const {
        detail::same_shape(starts, ends);
        detail::same_size("out", out.size(), starts.rows);
        detail::check(Of::motions(handle(), starts.data, ends.data, starts.rows, starts.columns, margin, resolution,
                                  open_loops, out.data()));
    }
    /// The pairs that touch or overlap, with the least translation that separates them.
    std::vector<typename Of::Overlap> penetrations(Argument<const double> q) const {
        std::vector<typename Of::Overlap> found(16);
        std::size_t count = penetrations(q, found);
        if (count > found.size()) {
            found.resize(count);
            count = penetrations(q, found);
        }
        found.resize(count);
        return found;
    }
    /// As above, as many as there is room for in `out`; returns how many there are.
    std::size_t penetrations(Argument<const double> q, Argument<typename Of::Overlap> out) const {
        std::size_t count = 0;
        detail::check(Of::penetrations(handle(), q.data(), q.size(), out.data(), out.size(), &count));
        return count;
    }
    /// The `k` nearest pairs, and the gradients of their distances: found x dofs values, NaN for pairs that touch.
    Gradients<typename Of::Pair> gradients(Argument<const double> q, std::size_t k) const {
        Gradients<typename Of::Pair> found{std::vector<typename Of::Pair>(k), std::vector<double>(k * q.size())};
        const std::size_t count = gradients(q, found.pairs, found.values);
        found.pairs.resize(count);
        found.values.resize(count * q.size());
        return found;
    }
    /// As above, as many as there is room for in `pairs`, and in `values`, pairs x dofs; returns how many there are.
    std::size_t gradients(Argument<const double> q, Argument<typename Of::Pair> pairs, Argument<double> values) const {
        std::size_t count = 0;
        detail::same_size("values", values.size(), pairs.size() * q.size());
        detail::check(Of::gradients(handle(), q.data(), q.size(), pairs.size(), pairs.data(), values.data(), &count));
        return count;
    }

    auto handle() const & noexcept { return handle_.get(); }
    auto handle() const && = delete; // it would be freed at once

protected:
    explicit Queries(typename Of::Handle::pointer handle) : handle_(handle) {}

private:
    typename Of::Handle handle_;
};

/// The shapes of a robot and obstacles, prepared for distances. Made by `Proximity::world_proximity`.
class WorldProximity : public Queries<detail::OfWorld> {
public:
    /// Moves the obstacles from index `first` on to other poses, without preparing anything again. Copies of this
    /// object share the obstacles; no other thread uses them during the call.
    void move_obstacles(std::size_t first, Argument<const Pose> poses) {
        const double *values = poses.size() == 0 ? nullptr : poses.data()->data();
        detail::check(urdd_world_proximity_move_obstacles(handle(), first, values, poses.size()));
    }
    /// The minimum distance, metres: 0 in a collision, infinite without pairs.
    double min_distance(Argument<const double> q) const {
        double found = 0;
        detail::check(urdd_world_proximity_min_distance(handle(), q.data(), 1, q.size(), &found));
        return found;
    }
    std::vector<double> min_distance_batch(Rows q) const {
        std::vector<double> found(q.rows);
        detail::check(urdd_world_proximity_min_distance(handle(), q.data, q.rows, q.columns, found.data()));
        return found;
    }

private:
    friend class Proximity;
    explicit WorldProximity(urdd_world_proximity *handle) : Queries(handle) {}
};

/// The shapes of one kind of a robot, prepared for distances, without the pairs that the URDD skips.
class Proximity : public Queries<detail::OfRobot> {
public:
    std::size_t num_shapes() const { return sizes()[0]; }
    std::size_t num_dofs() const { return sizes()[2]; }

    /// The minimum distance over all pairs, metres: 0 in a collision, infinite without pairs.
    double self_distance(Argument<const double> q) const {
        double found = 0;
        detail::check(urdd_proximity_self_distance(handle(), q.data(), 1, q.size(), &found));
        return found;
    }
    std::vector<double> self_distance_batch(Rows q) const {
        std::vector<double> found(q.rows);
        detail::check(urdd_proximity_self_distance(handle(), q.data, q.rows, q.columns, found.data()));
        return found;
    }
    /// The distance and the closest points of each pair.
    std::vector<urdd_pair_distance> closest_points(Argument<const double> q) const {
        std::vector<urdd_pair_distance> found(num_pairs());
        detail::check(urdd_proximity_closest_points(handle(), q.data(), 1, q.size(), found.data(), found.size()));
        return found;
    }
    /// These shapes and an object that a link carries; its pose is that in the link's frame. It is checked against all
    /// links that move against it, but those that it ignores.
    Proximity attach(std::size_t link, const Obstacle &object) const {
        return Proximity(detail::made<urdd_proximity>(
            [&](urdd_proximity **out) { return urdd_proximity_attach(handle(), link, object.handle(), out); }));
    }
    /// These shapes without some pairs of links or attached objects, which MoveIt calls the allowed collision matrix.
    Proximity without(const std::vector<std::pair<std::string, std::string>> &pairs) const {
        std::vector<const char *> names;
        for (const auto &[a, b] : pairs) {
            names.push_back(detail::c_text(a));
            names.push_back(detail::c_text(b));
        }
        return Proximity(detail::made<urdd_proximity>(
            [&](urdd_proximity **out) { return urdd_proximity_without(handle(), names.data(), pairs.size(), out); }));
    }
    /// These shapes without all of some links or attached objects, also among obstacles.
    Proximity without_bodies(const std::vector<std::string> &bodies) const {
        std::vector<const char *> names;
        for (const std::string &name : bodies)
            names.push_back(detail::c_text(name));
        return Proximity(detail::made<urdd_proximity>([&](urdd_proximity **out) {
            return urdd_proximity_without_bodies(handle(), names.data(), names.size(), out);
        }));
    }
    /// The number of bodies: of links, then of attached objects. Answers have their indices.
    std::size_t num_bodies() const {
        std::size_t found = 0;
        detail::check(urdd_proximity_num_bodies(handle(), &found));
        return found;
    }
    /// The index of a body.
    std::size_t body(const std::string &name) const {
        std::size_t found = 0;
        detail::check(urdd_proximity_body(handle(), detail::c_text(name), &found));
        return found;
    }
    /// The name of a body.
    std::string body_name(std::size_t body) const {
        urdd_text text{};
        detail::check(urdd_proximity_body_name(handle(), body, &text));
        return detail::string(text);
    }
    /// The same shapes with obstacles, which are copied.
    WorldProximity world_proximity(std::initializer_list<Obstacle> obstacles) const {
        return world_proximity(Span<const Obstacle>(obstacles.begin(), obstacles.size()));
    }
    WorldProximity world_proximity(Argument<const Obstacle> obstacles) const {
        const std::vector<const urdd_obstacle *> handles = detail::handles(obstacles);
        return WorldProximity(detail::made<urdd_world_proximity>([&](urdd_world_proximity **out) {
            return urdd_proximity_world_proximity(handle(), handles.data(), handles.size(), out);
        }));
    }

private:
    friend class Robot;
    explicit Proximity(urdd_proximity *handle) : Queries(handle) {}
    std::array<std::size_t, 3> sizes() const {
        std::array<std::size_t, 3> found{};
        detail::check(urdd_proximity_sizes(handle(), &found[0], &found[1], &found[2]));
        return found;
    }
};

} // namespace urdd

#endif
