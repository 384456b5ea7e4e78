// The learned self-collision model, and the pairs that need no check.

#ifndef URDD_COLLISION_MODEL_HPP
#define URDD_COLLISION_MODEL_HPP

#include "core.hpp"

namespace urdd {

/// The learned self-collision model: an estimate of the clearance between links, not a guarantee.
class CollisionModel {
public:
    std::size_t num_pairs() const {
        std::size_t found = 0;
        detail::check(urdd_collision_model_sizes(handle_.get(), &found, nullptr));
        return found;
    }
    std::vector<urdd_link_pair> pairs() const {
        std::vector<urdd_link_pair> found(num_pairs());
        detail::check(urdd_collision_model_pairs(handle_.get(), found.data(), found.size()));
        return found;
    }
    /// The estimated clearance of each pair, metres; 0 or less: the pair may be in contact.
    std::vector<double> clearances(Argument<const double> q) const {
        std::vector<double> found(num_pairs());
        detail::check(
            urdd_collision_model_clearances(handle_.get(), q.data(), 1, q.size(), found.data(), found.size()));
        return found;
    }
    /// Whether any pair may be in contact.
    bool may_collide(Argument<const double> q) const {
        bool found = false;
        detail::check(urdd_collision_model_may_collide(handle_.get(), q.data(), 1, q.size(), &found));
        return found;
    }
    /// The measured error rates, as JSON: `evaluation` of the module.
    std::string evaluation() const {
        urdd_text text{};
        detail::check(urdd_collision_model_evaluation(handle_.get(), &text));
        return detail::string(text);
    }

private:
    friend class Robot;
    explicit CollisionModel(urdd_collision_model *handle) : handle_(handle) {}
    detail::Handle<urdd_collision_model, urdd_collision_model_free> handle_;
};

/// The pairs of shapes of one kind that need no collision check.
class Skips {
public:
    std::size_t len() const {
        std::size_t found = 0;
        detail::check(urdd_skips_len(handle_.get(), &found));
        return found;
    }
    std::vector<urdd_shape_place> places() const {
        std::vector<urdd_shape_place> found(len());
        detail::check(urdd_skips_places(handle_.get(), found.data(), found.size()));
        return found;
    }
    bool is_skipped(std::size_t i, std::size_t j) const {
        bool found = false;
        detail::check(urdd_skips_is_skipped(handle_.get(), i, j, &found));
        return found;
    }

private:
    friend class Robot;
    explicit Skips(urdd_skips *handle) : handle_(handle) {}
    detail::Handle<urdd_skips, urdd_skips_free> handle_;
};

} // namespace urdd

#endif
