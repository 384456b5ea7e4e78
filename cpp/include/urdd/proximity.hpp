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

namespace detail {

struct OfRobot {
    using Handle = detail::Handle<urdd_proximity, urdd_proximity_free>;
    using Pair = urdd_pair_distance;
    static constexpr auto in_collision = urdd_proximity_in_collision;
    static constexpr auto nearest = urdd_proximity_nearest;
    static constexpr auto is_within = urdd_proximity_is_within;
    static constexpr auto blocked_edge = urdd_proximity_blocked_edge;
    static constexpr auto gradients = urdd_proximity_gradients;
};

struct OfWorld {
    using Handle = detail::Handle<urdd_world_proximity, urdd_world_proximity_free>;
    using Pair = urdd_obstacle_distance;
    static constexpr auto in_collision = urdd_world_proximity_in_collision;
    static constexpr auto nearest = urdd_world_proximity_nearest;
    static constexpr auto is_within = urdd_world_proximity_is_within;
    static constexpr auto blocked_edge = urdd_world_proximity_blocked_edge;
    static constexpr auto gradients = urdd_world_proximity_gradients;
};

} // namespace detail

/// What is asked of a robot's own pairs, and of the pairs of a shape of the robot and a convex part of an obstacle.
template <typename Of> class Queries {
public:
    /// Whether any pair touches or overlaps.
    bool in_collision(Span<const double> q) const {
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
    std::vector<typename Of::Pair> nearest(Span<const double> q, std::size_t k) const {
        std::vector<typename Of::Pair> found(k);
        std::size_t count = 0;
        detail::check(Of::nearest(handle(), q.data(), 1, q.size(), k, found.data(), &count));
        found.resize(count);
        return found;
    }
    /// Whether any pair is at most `margin` apart, metres. It stops at the first such pair.
    bool is_within(Span<const double> q, double margin) const {
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
    /// the halves first; with 0, the motion is proved free, which needs 0.1 mm more than the margin.
    double blocked_edge(Span<const double> start, Span<const double> end, double margin = 0.0,
                        double resolution = 0.01) const {
        return blocked_edge_batch({start.data(), 1, start.size()}, {end.data(), 1, end.size()}, margin, resolution)[0];
    }
    std::vector<double> blocked_edge_batch(Rows starts, Rows ends, double margin = 0.0,
                                           double resolution = 0.01) const {
        detail::same_shape(starts, ends);
        std::vector<double> found(starts.rows);
        detail::check(Of::blocked_edge(handle(), starts.data, ends.data, starts.rows, starts.columns, margin,
                                       resolution, found.data()));
        return found;
    }
    /// The `k` nearest pairs, and the gradients of their distances: found x dofs values, NaN for pairs that touch.
    Gradients<typename Of::Pair> gradients(Span<const double> q, std::size_t k) const {
        Gradients<typename Of::Pair> found{std::vector<typename Of::Pair>(k), std::vector<double>(k * q.size())};
        std::size_t count = 0;
        detail::check(Of::gradients(handle(), q.data(), q.size(), k, found.pairs.data(), found.values.data(), &count));
        found.pairs.resize(count);
        found.values.resize(count * q.size());
        return found;
    }

    auto handle() const noexcept { return handle_.get(); }

protected:
    explicit Queries(typename Of::Handle::pointer handle) : handle_(handle) {}

private:
    typename Of::Handle handle_;
};

/// The shapes of a robot and obstacles, prepared for distances. Made by `Proximity::world_proximity`.
class WorldProximity : public Queries<detail::OfWorld> {
public:
    /// The minimum distance, metres: 0 in a collision, infinite without pairs.
    double min_distance(Span<const double> q) const {
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
    std::size_t num_pairs() const { return sizes()[1]; }
    std::size_t num_dofs() const { return sizes()[2]; }

    /// The pairs that are checked, in the order of `distances`.
    std::vector<urdd_pair> pairs() const {
        std::vector<urdd_pair> found(num_pairs());
        detail::check(urdd_proximity_pairs(handle(), found.data(), found.size()));
        return found;
    }
    /// The minimum distance over all pairs, metres: 0 in a collision, infinite without pairs.
    double self_distance(Span<const double> q) const {
        double found = 0;
        detail::check(urdd_proximity_self_distance(handle(), q.data(), 1, q.size(), &found));
        return found;
    }
    std::vector<double> self_distance_batch(Rows q) const {
        std::vector<double> found(q.rows);
        detail::check(urdd_proximity_self_distance(handle(), q.data, q.rows, q.columns, found.data()));
        return found;
    }
    /// The distance of each pair, metres.
    std::vector<double> distances(Span<const double> q) const { return distances_batch({q.data(), 1, q.size()}); }
    /// As above, into `out`: rows x pairs.
    void distances(Rows q, Span<double> out) const {
        detail::check(urdd_proximity_distances(handle(), q.data, q.rows, q.columns, out.data(), out.size()));
    }
    std::vector<double> distances_batch(Rows q) const {
        std::vector<double> found(q.rows * num_pairs());
        distances(q, found);
        return found;
    }
    /// The distance and the closest points of each pair.
    std::vector<urdd_pair_distance> closest_points(Span<const double> q) const {
        std::vector<urdd_pair_distance> found(num_pairs());
        detail::check(urdd_proximity_closest_points(handle(), q.data(), 1, q.size(), found.data(), found.size()));
        return found;
    }
    /// The pairs that touch or overlap, with the least translation that separates them.
    std::vector<urdd_overlap> penetrations(Span<const double> q) const {
        std::vector<urdd_overlap> found(num_pairs());
        std::size_t count = 0;
        detail::check(urdd_proximity_penetrations(handle(), q.data(), q.size(), found.data(), found.size(), &count));
        found.resize(count);
        return found;
    }
    /// These shapes and an object that a link carries; its pose is that in the link's frame. It is checked against all
    /// links that move against it, but those that it ignores.
    Proximity attach(std::size_t link, const Obstacle &object) const {
        return Proximity(detail::made<urdd_proximity>(
            [&](urdd_proximity **out) { return urdd_proximity_attach(handle(), link, object.handle(), out); }));
    }
    /// The same shapes with obstacles, which are copied.
    WorldProximity world_proximity(Span<const Obstacle> obstacles) const {
        std::vector<const urdd_obstacle *> handles;
        handles.reserve(obstacles.size());
        for (const Obstacle &obstacle : obstacles)
            handles.push_back(obstacle.handle());
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
