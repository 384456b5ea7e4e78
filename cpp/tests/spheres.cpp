// Checks by spheres, compared with distances of their centres. Built with the sanitizers by .ci/cpp.

#include "check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <thread>
#include <urdd.hpp>

namespace {

double apart(const urdd::Point &a, const urdd::Point &b) {
    return std::sqrt(std::pow(a[0] - b[0], 2) + std::pow(a[1] - b[1], 2) + std::pow(a[2] - b[2], 2));
}

/// What the spheres of a few links are asked about.
struct Scene {
    const urdd::Robot &robot;
    std::vector<urdd::LinkSphere> spheres;
    std::vector<urdd::LinkPair> pairs;
    std::vector<urdd::Point> points; ///< obstacles of the last link
    double radius;                   ///< of each of them

    /// The distance of a configuration's nearest two, metres, by link poses.
    double distance(urdd::Span<const double> q) const {
        const urdd::Poses poses = robot.link_poses(q);
        const auto centre = [&](const urdd::LinkSphere &sphere) {
            return urdd::transform(poses[sphere.link], {sphere.centre[0], sphere.centre[1], sphere.centre[2]});
        };
        double least = std::numeric_limits<double>::infinity();
        for (const urdd::LinkSphere &a : spheres) {
            for (const urdd::LinkSphere &b : spheres) {
                for (const urdd::LinkPair &pair : pairs) {
                    if (a.link == pair.links[0] && b.link == pair.links[1])
                        least = std::min(least, apart(centre(a), centre(b)) - a.radius - b.radius);
                }
            }
            if (a.link + 1 != robot.num_links()) continue;
            for (const urdd::Point &point : points)
                least = std::min(least, apart(centre(a), point) - a.radius - radius);
        }
        return least;
    }
};

/// Holds both checkers to a scene, alone and in batches; returns how many configurations touch.
std::size_t hold(const Scene &scene, const urdd::CoveringChecker &covering, const urdd::ApproximatingChecker &near,
                 double margin) {
    const std::size_t dofs = scene.robot.num_dofs(), count = 500;
    const std::vector<double> all = scene.robot.random(0, count);
    const urdd::Rows rows(all, dofs);
    const std::vector<urdd::CoveringAnswer> covered = covering.is_within_batch(rows, margin);
    const std::vector<urdd::ApproximateAnswer> approximate = near.is_within_batch(rows, margin);
    std::size_t touching = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const urdd::Span<const double> q(&all[k * dofs], dofs);
        const double distance = scene.distance(q);
        // In the band of what is rounded, nothing is said.
        if (std::abs(distance - margin) < 1e-4) continue;
        touching += distance < margin ? 1 : 0;
        CHECK((covered[k] == urdd::CoveringAnswer::maybe) == (distance < margin));
        CHECK((approximate[k] == urdd::ApproximateAnswer::contact) == (distance < margin));
        CHECK(covering.is_within(q, margin) == covered[k] && near.is_within(q, margin) == approximate[k]);
        if (margin == 0.0) CHECK(covering.in_collision(q) == covered[k] && near.in_collision(q) == approximate[k]);
    }
    return touching;
}

void given(const urdd::Robot &robot) {
    const std::size_t tip = robot.num_links() - 1, dofs = robot.num_dofs();
    Scene scene{robot,
                {{0, 0, {0, 0, 0.1}, 0.4}, {0, tip, {0, 0, 0.05}, 0.3}, {0, tip, {0.1, 0, 0}, 0.1}},
                {{{0, tip}}},
                {},
                0.03};
    const urdd::CoveringChecker covering = robot.covering_checker(scene.spheres, scene.pairs);
    const urdd::ApproximatingChecker near = robot.approximating_checker(scene.spheres, scene.pairs);
    CHECK(covering.num_dofs() == dofs && near.num_dofs() == dofs);
    const std::size_t alone = hold(scene, covering, near, 0.0), wide = hold(scene, covering, near, 0.1);
    CHECK(alone > 10 && alone < wide && wide < 490);

    // A cloud about the root, which only the tip must not touch.
    for (int k = 0; k < 200; ++k)
        scene.points.push_back({0.9 * std::cos(k), 0.9 * std::sin(k), 0.005 * k});
    const urdd::Obstacle cloud =
        urdd::Obstacle::points("cloud", urdd::identity(), scene.points, scene.radius).ignoring(robot.link_names()[0]);
    urdd::CoveringChecker around = covering.around({cloud});
    urdd::ApproximatingChecker near_around = near.around(std::vector<urdd::Obstacle>{cloud});
    const std::size_t among = hold(scene, around, near_around, 0.0);
    CHECK(among > alone && among < 490);
    const std::vector<urdd::Pose> up{urdd::translation(0.1, 0, 0.7)};
    around.move_obstacles(0, up);
    near_around.move_obstacles(0, up);
    for (urdd::Point &point : scene.points)
        point = urdd::transform(up[0], point);
    CHECK(hold(scene, around, near_around, 0.0) != among);

    // Motions, one by one and at once.
    const std::size_t count = 60;
    const std::vector<double> all = robot.random(0, count + 1);
    const urdd::Rows starts(all.data(), count, dofs), ends(all.data() + dofs, count, dofs);
    const std::vector<double> blocked = around.blocked_edge_batch(starts, ends, 0.0, 0.02);
    const std::vector<urdd::FirstContact> contacts = around.first_contact_batch(starts, ends, 0.0, 0.02);
    std::size_t free = 0, later = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const urdd::Span<const double> from(&all[k * dofs], dofs), to(&all[(k + 1) * dofs], dofs);
        const double part = around.blocked_edge(from, to, 0.0, 0.02);
        CHECK(part == blocked[k] || (std::isnan(part) && std::isnan(blocked[k])));
        const urdd::FirstContact contact = around.first_contact(from, to, 0.0, 0.02);
        CHECK(contact.blocked == contacts[k].blocked || !contact.is_blocked());
        CHECK(contact.is_blocked() == !std::isnan(part) && contact.is_blocked() == contacts[k].is_blocked());
        const auto distance = [&](double at) {
            std::vector<double> q(dofs);
            for (std::size_t dof = 0; dof < dofs; ++dof)
                q[dof] = from[dof] + at * (to[dof] - from[dof]);
            return scene.distance(q);
        };
        if (!contact.is_blocked()) {
            ++free;
            for (int step = 0; step <= 20; ++step)
                CHECK(distance(step / 20.0) > -0.02);
            continue;
        }
        CHECK(distance(part) < 1e-4 && distance(contact.blocked) < 1e-4 && contact.blocked <= part);
        if (contact.free == 0.0) continue;
        ++later;
        CHECK(distance(contact.free) > -1e-4 && contact.blocked - contact.free < 1e-4);
    }
    CHECK(free > 0 && later > 0);
    std::vector<std::thread> threads;
    for (int k = 0; k < 4; ++k) {
        threads.emplace_back(
            [&] { CHECK(near_around.in_collision_batch(starts) == near_around.is_within_batch(starts, 0)); });
    }
    for (std::thread &thread : threads)
        thread.join();
}

/// The spheres of the URDD: what covering ones call free is free.
void of_the_urdd(const urdd::Robot &robot) {
    const urdd::CoveringChecker covering = robot.covering_checker();
    const urdd::ApproximatingChecker near = robot.approximating_checker();
    const urdd::Proximity shapes = robot.proximity();
    const std::vector<urdd::Obstacle> obstacles{urdd::Obstacle::height_field("ground", urdd::translation(-1, -1, -0.3),
                                                                             std::vector<double>(400, 0.2), 20,
                                                                             {0.1, 0.1}, 0.1),
                                                urdd::Obstacle::sphere("ball", {0.1, 0, 0.3}, 0.05)};
    const urdd::CoveringChecker around = covering.around(obstacles);
    const urdd::WorldProximity world = shapes.world_proximity(obstacles);
    const std::size_t dofs = robot.num_dofs(), count = 400;
    const std::vector<double> all = robot.random(0, count);
    std::size_t free = 0, maybe = 0, right = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const urdd::Span<const double> q(&all[k * dofs], dofs);
        const bool collides = shapes.in_collision(q);
        right += (near.in_collision(q) == urdd::ApproximateAnswer::contact) == collides ? 1 : 0;
        if (covering.in_collision(q) == urdd::CoveringAnswer::free) CHECK(!collides);
        switch (around.in_collision(q)) {
        case urdd::CoveringAnswer::free:
            ++free;
            CHECK(!collides && !world.in_collision(q));
            break;
        case urdd::CoveringAnswer::maybe: ++maybe; break;
        }
    }
    std::printf("spheres: %zu free, %zu maybe, %zu of %zu right\n", free, maybe, right, count);
    CHECK(right * 10 > count * 9 && free > 0 && maybe > 0);
}

void mistakes(const urdd::Robot &robot, const urdd::Robot &without) {
    CHECK(thrown([&] { without.covering_checker(); }) == URDD_STATUS_MISSING_MODULE);
    CHECK(thrown([&] { without.approximating_checker(); }) == URDD_STATUS_MISSING_MODULE);
    std::vector<urdd::LinkSphere> spheres{{0, 0, {0, 0, 0}, std::numeric_limits<double>::quiet_NaN()}};
    CHECK(thrown([&] { robot.covering_checker(spheres, {}); }) == URDD_STATUS_VALUE);
    spheres[0].radius = -1;
    CHECK(thrown([&] { robot.approximating_checker(spheres, {}); }) == URDD_STATUS_VALUE);
    spheres[0] = {0, 99, {0, 0, 0}, 1};
    CHECK(thrown([&] { robot.covering_checker(spheres, {}); }) == URDD_STATUS_OUT_OF_RANGE);
    urdd::CoveringChecker checker = robot.covering_checker();
    std::vector<double> q = robot.zero();
    CHECK(thrown([&] { checker.is_within(q, -1); }) == URDD_STATUS_VALUE);
    CHECK(thrown([&] { checker.blocked_edge(q, q, 0, 0); }) == URDD_STATUS_VALUE);
    CHECK(thrown([&] { checker.move_obstacles(0, std::vector<urdd::Pose>(1, urdd::identity())); }) ==
          URDD_STATUS_OUT_OF_RANGE);
    q.push_back(0);
    CHECK(thrown([&] { checker.in_collision(q); }) == URDD_STATUS_LENGTH);
    const std::vector<urdd::Point> points{{0, 0, 0}};
    CHECK(thrown([&] { urdd::Obstacle::points("cloud", urdd::identity(), points, -1); }) == URDD_STATUS_VALUE);
    CHECK(thrown([&] { urdd::Obstacle::points("cloud", urdd::identity(), {}, 1); }) == URDD_STATUS_VALUE);
    const std::vector<double> heights(5, 0.1);
    const auto field = [&](std::size_t columns) {
        urdd::Obstacle::height_field("f", urdd::identity(), heights, columns, {1, 1}, 1);
    };
    CHECK(thrown([&] { field(5); }) == URDD_STATUS_OK);
    CHECK(thrown([&] { field(2); }) == URDD_STATUS_LENGTH && thrown([&] { field(0); }) == URDD_STATUS_LENGTH);
    CHECK(thrown([&] { checker.around({urdd::Obstacle::sphere("s", {0, 0, 0}, 1).ignoring("nothing")}); }) ==
          URDD_STATUS_UNKNOWN_NAME);
}

} // namespace

int main(int count, char **words) {
    CHECK(count == 4);
    const urdd::Robot arm = urdd::Robot::open(words[1]), gripper = urdd::Robot::open(words[2]);
    given(arm);
    of_the_urdd(gripper);
    mistakes(gripper, urdd::Robot::open(words[3]));
    std::puts("spheres: ok");
}
