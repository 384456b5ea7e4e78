// A robot to ask about itself, from a URDD: poses, Jacobians, inverse kinematics, distances and collisions. C++17,
// header only, over the C interface in urdd.h, whose head has the rules for threads and numbers. docs/cpp.md has
// examples.
//
// Names are those of Rust and Python. A function throws `urdd::Error` where the C function returns a status. Objects
// are movable, never change after they are made, and can be asked from any number of threads at once. A configuration
// is anything with `data()` and `size()` of doubles: std::vector, std::array, Eigen vectors. Functions that write to a
// `Span` do not allocate for one configuration.
//
// <urdd/eigen.hpp> shows results as Eigen matrices.

#ifndef URDD_HPP
#define URDD_HPP

#include "urdd/collision_model.hpp"
#include "urdd/core.hpp"
#include "urdd/obstacle.hpp"
#include "urdd/proximity.hpp"
#include "urdd/robot.hpp"
#include "urdd/spheres.hpp"
#include "urdd/validate.hpp"

#endif
