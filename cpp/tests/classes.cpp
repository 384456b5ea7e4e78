// The classes of urdd.hpp. Built with the address and undefined-behaviour sanitizers by .ci/cpp.

#include <Eigen/Core>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <thread>
#include <urdd.hpp>
#include <urdd/eigen.hpp>

#define CHECK(condition)                                                                                               \
    if (!(condition)) {                                                                                                \
        std::fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition);                                           \
        std::exit(1);                                                                                                  \
    }

namespace {

template <typename F> urdd_status thrown(F &&act) {
    try {
        act();
    } catch (const urdd::Error &error) {
        CHECK(std::string(error.what()).size() > 5);
        return error.status();
    }
    return URDD_STATUS_OK;
}

void kinematics(const urdd::Robot &robot) {
    const std::vector<double> q = robot.middle();
    const std::size_t tip = robot.num_links() - 1;
    CHECK(robot.link(robot.link_names()[tip]) == tip);
    CHECK(robot.dof_units()[0] == "rad");
    const std::vector<urdd::Pose> poses = robot.link_poses(q);
    CHECK(poses.size() == robot.num_links());

    // The Jacobian is the derivative of the position, by central differences.
    const std::vector<double> jacobian = robot.jacobian(q, tip);
    const auto map = urdd::jacobian_map(jacobian);
    for (std::size_t dof = 0; dof < q.size(); ++dof) {
        std::vector<double> more = q, less = q;
        more[dof] += 1e-6;
        less[dof] -= 1e-6;
        const urdd::Pose a = robot.link_poses(more)[tip], b = robot.link_poses(less)[tip];
        const Eigen::Vector3d change =
            (urdd::pose_map(a).topRightCorner<3, 1>() - urdd::pose_map(b).topRightCorner<3, 1>()) / 2e-6;
        CHECK((change - map.block<3, 1>(0, static_cast<Eigen::Index>(dof))).norm() < 1e-7);
    }
    const urdd::Inverse found = robot.inverse_kinematics(tip, poses[tip], robot.zero());
    CHECK(found.is_reached());
    const urdd::Pose there = robot.link_poses(found.configuration)[tip];
    CHECK((urdd::pose_map(there) - urdd::pose_map(poses[tip])).norm() < 1e-5);
    // A pose that the robot has without touching itself is found without.
    urdd_inverse_settings settings = urdd::inverse_settings();
    const urdd::Proximity shapes = robot.proximity(urdd::ShapeKind::hulls);
    settings.free_of = shapes.handle();
    const urdd::Inverse free = robot.inverse_kinematics(tip, poses[tip], robot.zero(), settings);
    CHECK(free.solution.verdict == (free.is_reached() ? URDD_VERDICT_REACHED : URDD_VERDICT_REFUSED));
    if (free.is_reached()) CHECK(!shapes.in_collision(free.configuration));
    CHECK(robot.velocity_limits().size() == q.size() && robot.effort_limits()[0] > 0);
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
    double mass = 0;
    for (std::size_t link = 0; link < poses.size(); ++link) {
        const std::array<double, 4> own = robot.link_masses()[link];
        moment += own[0] * (urdd::pose_map(poses[link]) * Eigen::Vector4d(own[1], own[2], own[3], 1)).head<3>();
        mass += own[0];
    }
    const urdd::Point centre = robot.centre_of_mass(q);
    CHECK((moment / mass - Eigen::Vector3d(centre[0], centre[1], centre[2])).norm() < 1e-12);

    const Eigen::VectorXd eigen = Eigen::Map<const Eigen::VectorXd>(q.data(), static_cast<Eigen::Index>(q.size()));
    CHECK(robot.link_poses(eigen) == poses);
    std::vector<double> far(q.size(), 100.0);
    robot.clamp(far);
    CHECK(far[0] == robot.bounds()[0][1]);
}

/// What planners ask: margins, motions, gradients, objects that links carry.
void planning(const urdd::Robot &robot, const urdd::Proximity &proximity, const urdd::WorldProximity &world,
              const std::vector<double> &all) {
    const std::size_t dofs = robot.num_dofs(), count = all.size() / dofs;
    const urdd::Rows rows{all.data(), count, dofs}, next{all.data() + dofs, count - 1, dofs};
    const std::vector<bool> within = proximity.is_within_batch(rows, 0.05);
    const std::vector<double> blocked = proximity.blocked_edge_batch({all.data(), count - 1, dofs}, next, 0.0, 0.05);
    const urdd::Obstacle part = urdd::Obstacle::cuboid("part", urdd::translation(0, 0, 0.1), {0.05, 0.1, 0.1});
    const urdd::Proximity holding = proximity.attach(robot.link(robot.link_names().back()), part);
    CHECK(holding.num_pairs() > proximity.num_pairs());
    std::size_t overlapping = 0;
    for (std::size_t k = 0; k + 1 < count; ++k) {
        const urdd::Span<const double> q(&all[k * dofs], dofs), end(&all[(k + 1) * dofs], dofs);
        CHECK(within[k] == (proximity.self_distance(q) <= 0.05) && within[k] == proximity.is_within(q, 0.05));
        CHECK(world.is_within(q, 0.05) == (world.min_distance(q) <= 0.05));
        const double part_of_way = proximity.blocked_edge(q, end, 0.0, 0.05);
        CHECK(part_of_way == blocked[k] || (std::isnan(part_of_way) && std::isnan(blocked[k])));
        CHECK(std::isnan(world.blocked_edge(q, q)) == !world.in_collision(q));
        CHECK(holding.self_distance(q) <= proximity.self_distance(q));
        const auto overlaps = proximity.penetrations(q);
        CHECK(overlaps.empty() == !proximity.in_collision(q));
        overlapping += overlaps.size();
        // The distance after a small step, as its gradient has it.
        const auto found = world.gradients(q, 1);
        std::vector<double> moved(q.data(), q.data() + dofs);
        moved[1] += 1e-7;
        if (found.pairs[0].distance > 0.01) {
            const double step = (world.min_distance(moved) - found.pairs[0].distance) / 1e-7;
            CHECK(std::abs(step - found.values[1]) < 1e-3);
        }
        CHECK(proximity.gradients(q, 3).values.size() == 3 * dofs);
    }
    CHECK(overlapping > 0);
    const urdd::Obstacle ball = urdd::Obstacle::sphere("ball", {9, 9, 9}, 0.2);
    const std::vector<urdd::Obstacle> moved = [&] {
        std::vector<urdd::Obstacle> obstacles;
        obstacles.push_back(ball.at(urdd::translation(0.5, 0.0, 0.5)));
        return obstacles;
    }();
    const urdd::Span<const double> first(all.data(), dofs);
    const std::vector<urdd::Obstacle> made = [&] {
        std::vector<urdd::Obstacle> obstacles;
        obstacles.push_back(urdd::Obstacle::sphere("ball", {0.5, 0.0, 0.5}, 0.2));
        return obstacles;
    }();
    CHECK(proximity.world_proximity(moved).min_distance(first) == proximity.world_proximity(made).min_distance(first));
    CHECK(thrown([&] { proximity.is_within(first, -1.0); }) == URDD_STATUS_VALUE);
    CHECK(thrown([&] { proximity.blocked_edge_batch(rows, next); }) == URDD_STATUS_LENGTH);
    CHECK(thrown([&] { holding.attach(0, part); }) == URDD_STATUS_VALUE);
}

void distances(const urdd::Robot &robot) {
    const urdd::Proximity proximity = robot.proximity(urdd::ShapeKind::pieces);
    const std::size_t count = 100;
    const std::vector<double> all = robot.random(0, count);
    const urdd::Rows rows{all.data(), count, robot.num_dofs()};
    const std::vector<bool> touches = proximity.in_collision_batch(rows);
    const std::vector<double> least = proximity.self_distance_batch(rows);
    const urdd::WorldProximity world = [&] {
        std::vector<urdd::Obstacle> obstacles;
        obstacles.push_back(urdd::Obstacle::sphere("ball", {0.5, 0.0, 0.5}, 0.2));
        obstacles.push_back(urdd::Obstacle::cuboid("floor", urdd::translation(0, 0, -0.06), {2, 2, 0.05})
                                .ignoring(robot.link_names()[0]));
        return proximity.world_proximity(obstacles);
    }();
    std::size_t near_ball = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const urdd::Span<const double> q(&all[k * robot.num_dofs()], robot.num_dofs());
        CHECK(proximity.in_collision(q) == touches[k]);
        CHECK((least[k] == 0.0) == touches[k]);
        const std::vector<urdd_pair_distance> near = proximity.nearest(q, 1);
        CHECK(near.size() == 1 && near[0].distance == least[k]);
        double squared = 0;
        for (int axis = 0; axis < 3; ++axis)
            squared += std::pow(near[0].points[0][axis] - near[0].points[1][axis], 2);
        CHECK(std::abs(std::sqrt(squared) - least[k]) < 1e-9);
        CHECK(world.in_collision(q) == (world.min_distance(q) == 0.0));
        near_ball += world.in_collision(q) ? 1 : 0;
    }
    CHECK(near_ball > 0 && near_ball < count);
    planning(robot, proximity, world, all);
    const urdd::Skips skips = robot.skips();
    CHECK(skips.len() == proximity.num_shapes() && skips.is_skipped(0, 0));

    std::vector<std::thread> threads;
    for (int k = 0; k < 4; ++k) {
        threads.emplace_back([&] { CHECK(proximity.self_distance_batch(rows) == least); });
    }
    for (std::thread &thread : threads)
        thread.join();
}

void mistakes(const urdd::Robot &robot, const std::string &path) {
    CHECK(thrown([] { urdd::Robot::open("/nowhere"); }) == URDD_STATUS_OPEN);
    CHECK(thrown([&] { robot.link("nothing"); }) == URDD_STATUS_UNKNOWN_NAME);
    std::vector<double> q = robot.zero();
    q.push_back(0.0);
    CHECK(thrown([&] { robot.link_poses(q); }) == URDD_STATUS_LENGTH);
    q.pop_back();
    q[0] = std::numeric_limits<double>::quiet_NaN();
    CHECK(thrown([&] { robot.link_poses(q); }) == URDD_STATUS_VALUE);
    CHECK(thrown([&] { robot.jacobian(robot.zero(), 1000); }) == URDD_STATUS_OUT_OF_RANGE);
    CHECK(thrown([&] { urdd::Obstacle::sphere("ball", {0, 0, 0}, -1); }) == URDD_STATUS_VALUE);
    CHECK(thrown([&] { urdd::Obstacle::hull("none", urdd::identity(), {}); }) == URDD_STATUS_VALUE);
    CHECK(thrown([&] { urdd::validate(path, "nonsense"); }) == URDD_STATUS_VALUE);
    CHECK(urdd::validate(path).passes);
}

} // namespace

int main(int count, char **words) {
    CHECK(count == 2);
    const urdd::Robot robot = urdd::Robot::open(words[1]);
    kinematics(robot);
    distances(robot);
    mistakes(robot, words[1]);
    std::puts("classes: ok");
}
