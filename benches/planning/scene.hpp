// What both checkers are asked about: a robot of hulls, a floor, and boxes and balls around it.

#ifndef PLANNING_SCENE_HPP
#define PLANNING_SCENE_HPP

#include <fstream>
#include <urdd.hpp>
#include <urdd_types.hpp>

namespace types = urdd::types;

struct Box {
    urdd::Point centre, half_extents;
};
struct Ball {
    urdd::Point centre;
    double radius;
};

/// Metres, in the root link's frame. The robot stands on the first box: its root link may touch it.
struct Scene {
    std::vector<Box> boxes{
        {{0, 0, -0.05}, {2, 2, 0.05}},           {{0.55, 0.35, 0.4}, {0.04, 0.04, 0.4}},
        {{0.55, -0.35, 0.4}, {0.04, 0.04, 0.4}}, {{0.6, 0, 0.75}, {0.3, 0.4, 0.02}},
        {{-0.45, 0, 0.3}, {0.02, 0.5, 0.3}},
    };
    std::vector<Ball> balls{{{0.3, 0.5, 0.5}, 0.12}, {{0.3, -0.5, 0.5}, 0.12}, {{0, 0, 1.15}, 0.1}};
};

inline std::vector<urdd::Obstacle> obstacles(const Scene &scene, const std::string &root) {
    std::vector<urdd::Obstacle> found;
    for (const Box &box : scene.boxes) {
        const auto [x, y, z] = box.centre;
        auto one =
            urdd::Obstacle::cuboid("box " + std::to_string(found.size()), urdd::translation(x, y, z), box.half_extents);
        found.push_back(found.empty() ? one.ignoring(root) : std::move(one));
    }
    for (const Ball &ball : scene.balls) {
        found.push_back(urdd::Obstacle::sphere("ball " + std::to_string(found.size()), ball.centre, ball.radius));
    }
    return found;
}

#endif
