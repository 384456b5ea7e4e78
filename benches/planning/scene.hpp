// What both checkers are asked about: a robot of hulls, among a floor, boxes and balls, or what a problem has.

#ifndef PLANNING_SCENE_HPP
#define PLANNING_SCENE_HPP

#include <cmath>
#include <fstream>
#include <urdd.hpp>
#include <urdd_types.hpp>

namespace types = urdd::types;

struct Box {
    urdd::Point centre, half_extents;
    urdd::Point rpy{0, 0, 0};
};
/// All points within `radius` of a segment along z.
struct Capsule {
    urdd::Point centre, rpy;
    double radius, half_length;
};
struct Ball {
    urdd::Point centre;
    double radius;
};

/// Fixed axes: about x, then y, then z.
inline urdd::Pose pose_of(const urdd::Point &centre, const urdd::Point &rpy) {
    const double sr = std::sin(rpy[0]), cr = std::cos(rpy[0]), sp = std::sin(rpy[1]), cp = std::cos(rpy[1]);
    const double sy = std::sin(rpy[2]), cy = std::cos(rpy[2]);
    return {cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr, centre[0],
            sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr, centre[1],
            -sp,     cp * sr,                cp * cr,                centre[2],
            0,       0,                      0,                      1};
}

/// Metres, in the root link's frame. If the robot stands on the first box, its root link may touch it.
struct Scene {
    std::vector<Box> boxes{
        {{0, 0, -0.05}, {2, 2, 0.05}},           {{0.55, 0.35, 0.4}, {0.04, 0.04, 0.4}},
        {{0.55, -0.35, 0.4}, {0.04, 0.04, 0.4}}, {{0.6, 0, 0.75}, {0.3, 0.4, 0.02}},
        {{-0.45, 0, 0.3}, {0.02, 0.5, 0.3}},
    };
    std::vector<Ball> balls{{{0.3, 0.5, 0.5}, 0.12}, {{0.3, -0.5, 0.5}, 0.12}, {{0, 0, 1.15}, 0.1}};
    std::vector<Capsule> capsules;
    bool stands_on_first = true;
};

inline std::vector<urdd::Obstacle> obstacles(const Scene &scene, const std::string &root) {
    std::vector<urdd::Obstacle> found;
    for (const Box &box : scene.boxes) {
        auto one = urdd::Obstacle::cuboid("box " + std::to_string(found.size()), pose_of(box.centre, box.rpy),
                                          box.half_extents);
        found.push_back(found.empty() && scene.stands_on_first ? one.ignoring(root) : std::move(one));
    }
    for (const Ball &ball : scene.balls) {
        found.push_back(urdd::Obstacle::sphere("ball " + std::to_string(found.size()), ball.centre, ball.radius));
    }
    for (const Capsule &one : scene.capsules) {
        found.push_back(urdd::Obstacle::capsule("capsule " + std::to_string(found.size()),
                                                pose_of(one.centre, one.rpy), one.radius, one.half_length));
    }
    return found;
}

#endif
