// What a ROS 2 node does: load once, then ask 1,000 times a second, without an allocation. Each round moves 20 boxes
// around the robot, and asks for the poses and the Jacobian of the last link, its own collisions, the distance to the
// boxes, and the gradient of the nearest. Prints the microseconds of a round.
//   control_loop URDD

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <new>
#include <thread>
#include <urdd.hpp>

// Counts what this program allocates; a test of the library counts what it allocates itself.
static std::size_t allocations = 0;

void *operator new(std::size_t size) {
    ++allocations;
    if (void *memory = std::malloc(size)) return memory;
    throw std::bad_alloc();
}
void operator delete(void *memory) noexcept { std::free(memory); }
void operator delete(void *memory, std::size_t) noexcept { std::free(memory); }

int main(int count, char **words) {
    if (count != 2) {
        std::cerr << "usage: control_loop URDD\n";
        return 2;
    }
    using Clock = std::chrono::steady_clock;
    const urdd::Robot robot = urdd::Robot::open(words[1]);
    const std::size_t links = robot.num_links(), dofs = robot.num_dofs(), tip = links - 1;
    const urdd::Proximity proximity = robot.proximity();
    std::vector<urdd::Pose> places(20);
    const auto place = [&](std::size_t round) {
        for (std::size_t k = 0; k < places.size(); ++k) {
            const double angle = 0.3 * static_cast<double>(k) + 0.001 * static_cast<double>(round);
            const double height = 0.1 + 0.05 * static_cast<double>(k);
            places[k] = urdd::translation(1.2 * std::cos(angle), 1.2 * std::sin(angle), height);
        }
    };
    place(0);
    std::vector<urdd::Obstacle> obstacles;
    for (std::size_t k = 0; k < places.size(); ++k)
        obstacles.push_back(urdd::Obstacle::cuboid("box " + std::to_string(k), places[k], {0.05, 0.1, 0.15}));
    urdd::WorldProximity world = proximity.world_proximity(obstacles);

    const std::vector<double> from = robot.random(0), to = robot.random(1);
    std::vector<double> q = from, jacobian(6 * dofs), gradient(dofs), microseconds;
    std::vector<urdd::Pose> poses(links);
    urdd_obstacle_distance nearest{};
    const std::size_t rounds = 2000;
    microseconds.reserve(rounds);
    std::size_t before = 0, slowed = 0;
    auto next = Clock::now();
    for (std::size_t k = 0; k < rounds; ++k) {
        if (k == 10) before = allocations;
        const auto began = Clock::now();
        for (std::size_t dof = 0; dof < dofs; ++dof) {
            q[dof] = from[dof] + (to[dof] - from[dof]) * static_cast<double>(k) / static_cast<double>(rounds);
        }
        place(k);
        world.move_obstacles(0, places);
        robot.link_poses({q.data(), 1, dofs}, poses);
        robot.jacobian(q, tip, {0, 0, 0}, jacobian);
        world.gradients(q, {&nearest, 1}, gradient);
        if (proximity.in_collision(q) || nearest.distance < 0.1) ++slowed;
        microseconds.push_back(std::chrono::duration<double, std::micro>(Clock::now() - began).count());
        next += std::chrono::milliseconds(1);
        std::this_thread::sleep_until(next);
    }
    const std::size_t made = allocations - before;
    std::sort(microseconds.begin(), microseconds.end());
    std::cout << rounds << " rounds, " << slowed << " near something: median " << microseconds[rounds / 2]
              << " us, 99th percentile " << microseconds[rounds * 99 / 100] << " us, slowest " << microseconds.back()
              << " us, " << made << " allocations\n";
    return made == 0 ? 0 : 1;
}
