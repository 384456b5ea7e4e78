// The classes of urdd.hpp. Built with the address and undefined-behaviour sanitizers by .ci/cpp.

#include "check.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <thread>
#include <urdd.hpp>
#include <urdd/eigen.hpp>

namespace {

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
    urdd::InverseSettings settings;
    settings.free_of = robot.proximity(urdd::ShapeKind::hulls); // owned: the temporary can go
    const urdd::Proximity shapes = *settings.free_of;
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
    Eigen::VectorXd torques = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(q.size()));
    for (std::size_t link = 0; link < poses.size(); ++link) {
        const std::array<double, 4> own = robot.link_masses()[link];
        torques += 9.81 * own[0] * urdd::jacobian(robot, q, link, {own[1], own[2], own[3]}).row(2).transpose();
    }
    const std::vector<double> held = robot.gravity_torques(q);
    CHECK((torques - Eigen::Map<const Eigen::VectorXd>(held.data(), torques.size())).norm() < 1e-12);
    // A payload in weightlessness does nothing.
    const urdd::Payload payload{3.0, poses.size() - 1, {0.1, 0.2, 0.3}};
    CHECK(robot.gravity_torques(q, payload, {0, 0, 0}) == std::vector<double>(q.size(), 0.0));
    torques += 9.81 * 3.0 * urdd::jacobian(robot, q, payload.link, payload.point).row(2).transpose();
    const std::vector<double> loaded = robot.gravity_torques_batch({q.data(), 1, q.size()}, payload);
    CHECK((torques - Eigen::Map<const Eigen::VectorXd>(loaded.data(), torques.size())).norm() < 1e-12);

    const Eigen::VectorXd eigen = Eigen::Map<const Eigen::VectorXd>(q.data(), static_cast<Eigen::Index>(q.size()));
    CHECK(robot.link_poses(eigen) == poses);
    std::vector<double> far(q.size(), 100.0);
    robot.clamp(far);
    CHECK(far[0] == robot.bounds()[0][1]);
}

/// Poses as matrices, products and inverses of them; Jacobians as matrices, and in batches.
void matrices(const urdd::Robot &robot) {
    const std::size_t dofs = robot.num_dofs(), tip = robot.num_links() - 1, count = 5;
    const std::vector<double> all = robot.random(0, count);
    const urdd::Rows rows(all, dofs);
    CHECK(rows.rows == count && rows.columns == dofs);
    const urdd::Poses poses = robot.link_poses_batch(rows);
    const Eigen::Isometry3d a = urdd::isometry(poses[tip]), b = urdd::isometry(poses[robot.num_links() + tip]);
    CHECK(urdd::pose(a) == poses[tip]);
    CHECK((urdd::isometry(urdd::compose(urdd::pose(a), urdd::pose(b))).matrix() - (a * b).matrix()).norm() < 1e-14);
    CHECK((urdd::isometry(urdd::inverse(urdd::pose(a))).matrix() - a.inverse().matrix()).norm() < 1e-14);
    const urdd::Point moved = urdd::transform(urdd::pose(a), {0.1, 0.2, 0.3});
    CHECK((a * Eigen::Vector3d(0.1, 0.2, 0.3) - Eigen::Vector3d(moved[0], moved[1], moved[2])).norm() < 1e-14);
    const std::vector<double> jacobians = robot.jacobian_batch(rows, tip);
    for (std::size_t k = 0; k < count; ++k) {
        const urdd::Span<const double> q(&all[k * dofs], dofs);
        const Eigen::MatrixXd one = urdd::jacobian(robot, q, tip);
        const Eigen::Map<const Eigen::MatrixXd> of_batch(&jacobians[6 * k * dofs], 6, static_cast<Eigen::Index>(dofs));
        CHECK((one - of_batch).norm() < 1e-13);
    }
    const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> matrix =
        Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
            all.data(), static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(dofs));
    CHECK(robot.link_poses_batch(urdd::rows(matrix)) == poses);
    CHECK(thrown([&] { urdd::Rows(all, dofs + 1); }) == URDD_STATUS_LENGTH);
    // Names, and the DOFs of the arm.
    CHECK(robot.joint(robot.joint_names().back()) == robot.joint_names().size() - 1);
    CHECK(robot.dofs_between(0, tip).size() == dofs && robot.dofs_between(tip, tip).empty());
    CHECK(robot.dof_is_limited() == std::vector<bool>({true, true, true, true, true, false}));
}

/// Many targets, by values and into buffers; settings that own what they name.
void inverse(const urdd::Robot &robot) {
    const std::size_t dofs = robot.num_dofs(), tip = robot.num_links() - 1, count = 4;
    const std::vector<double> all = robot.random(0, count), start = robot.zero();
    std::vector<urdd::Target> targets;
    for (std::size_t k = 0; k < count; ++k)
        targets.emplace_back(tip, robot.link_poses({&all[k * dofs], dofs})[tip]);
    urdd::InverseSettings settings;
    CHECK(settings.iterations > 0 && settings.restarts > 0 && settings.position_tolerance > 0);
    settings.free_of = robot.proximity();
    settings.free_of_world = settings.free_of->world_proximity({urdd::Obstacle::sphere("ball", {0.5, 0, 0.5}, 0.2)});
    settings.margin = 0.01;
    settings.posture = start;
    const auto found = robot.inverse_kinematics_batch(targets, {start, dofs}, settings);
    std::vector<double> configurations(count * dofs);
    std::vector<urdd_inverse_solution> solutions(count);
    robot.inverse_kinematics(targets, {start, dofs}, settings, configurations, solutions);
    std::size_t reached = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const urdd::Inverse one = robot.inverse_kinematics(targets[k], start, settings);
        CHECK(one.configuration == found[k].configuration);
        CHECK(std::equal(one.configuration.begin(), one.configuration.end(),
                         configurations.begin() + static_cast<std::ptrdiff_t>(k * dofs)));
        CHECK(one.is_reached() == solutions[k].is_reached);
        if (!one.is_reached()) continue;
        ++reached;
        CHECK(!settings.free_of->in_collision(one.configuration));
        CHECK(!settings.free_of_world->is_within(one.configuration, 0.01));
        const Eigen::Isometry3d there = urdd::isometry(robot.link_poses(one.configuration)[tip]);
        const Eigen::Isometry3d wanted = urdd::isometry(robot.link_poses({&all[k * dofs], dofs})[tip]);
        CHECK((there.matrix() - wanted.matrix()).norm() < 1e-5);
    }
    CHECK(reached > 0);
    const auto at = robot.inverse_kinematics(urdd::Target::position(tip, {0.4, 0.1, 0.6}), start);
    const Eigen::Isometry3d there = urdd::isometry(robot.link_poses(at.configuration)[tip]);
    CHECK(at.is_reached() && (there.translation() - Eigen::Vector3d(0.4, 0.1, 0.6)).norm() < 1e-5);
    settings.posture.pop_back();
    CHECK(thrown([&] { robot.inverse_kinematics(targets[0], start, settings); }) == URDD_STATUS_LENGTH);
    solutions.pop_back();
    CHECK(thrown([&] { robot.inverse_kinematics(targets, {start, dofs}, {}, configurations, solutions); }) ==
          URDD_STATUS_LENGTH);
}

/// Obstacles that move, pairs that are switched off, first contacts, results in the caller's arrays.
void motion(const urdd::Robot &robot) {
    const std::size_t dofs = robot.num_dofs();
    const urdd::Proximity proximity = robot.proximity();
    const urdd::Obstacle ball = urdd::Obstacle::sphere("ball", {9, 9, 9}, 0.2), copy = ball;
    urdd::WorldProximity world = proximity.world_proximity({ball, urdd::Obstacle::sphere("other", {9, 9, 9}, 0.1)});
    const std::vector<urdd::Pose> places{urdd::translation(0.5, 0, 0.5), urdd::translation(0.3, 0.4, 0.8)};
    world.move_obstacles(0, places);
    const urdd::WorldProximity made =
        proximity.world_proximity({copy.at(places[0]), urdd::Obstacle::sphere("other", {0.3, 0.4, 0.8}, 0.1)});
    CHECK(world.num_pairs() == 2 * proximity.num_shapes() && world.pairs().size() == world.num_pairs());
    const std::vector<double> all = robot.random(0, 60);
    std::size_t overlapping = 0, blocked = 0;
    for (std::size_t k = 0; k + 1 < 60; ++k) {
        const urdd::Span<const double> q(&all[k * dofs], dofs), end(&all[(k + 1) * dofs], dofs);
        const std::vector<double> distances = world.distances(q);
        CHECK(distances == made.distances(q));
        CHECK(*std::min_element(distances.begin(), distances.end()) == world.min_distance(q));
        const auto overlaps = world.penetrations(q);
        CHECK(overlaps.empty() == !world.in_collision(q));
        overlapping += overlaps.size();
        // Room for fewer than there are: as many as there are is said.
        CHECK(world.penetrations(q, urdd::Span<urdd_obstacle_overlap>()) == overlaps.size());
        std::array<urdd_obstacle_distance, 3> nearest{};
        std::vector<double> gradients(3 * dofs);
        CHECK(world.nearest(q, nearest) == 3 && nearest[0].distance == world.min_distance(q));
        CHECK(world.gradients(q, nearest, gradients) == 3);
        CHECK(nearest[0].distance == 0 || gradients == world.gradients(q, 3).values);
        const urdd::FirstContact contact = world.first_contact(q, end);
        CHECK(contact.is_blocked() == !std::isnan(world.blocked_edge(q, end)));
        if (!contact.is_blocked()) continue;
        ++blocked;
        std::vector<double> there(dofs);
        const auto at = [&](double part) {
            for (std::size_t dof = 0; dof < dofs; ++dof)
                there[dof] = q[dof] + part * (end[dof] - q[dof]);
            return world.in_collision(there);
        };
        CHECK(at(contact.blocked) && contact.free <= contact.blocked);
        for (int step = 0; step <= 50 && contact.free > 0; ++step)
            CHECK(!at(contact.free * step / 50));
    }
    CHECK(overlapping > 0 && blocked > 0);
    CHECK(thrown([&] { world.move_obstacles(1, places); }) == URDD_STATUS_OUT_OF_RANGE);
    // A pair that is switched off is not checked; a body that is switched off has no pairs.
    const auto pair = proximity.pairs()[0];
    const std::vector<std::string> links = robot.link_names();
    const std::string a = links[pair.links[0]], b = links[pair.links[1]];
    const urdd::Proximity without = proximity.without({{a, b}});
    for (const urdd_pair &other : without.pairs())
        CHECK(other.links[0] != pair.links[0] || other.links[1] != pair.links[1]);
    CHECK(without.num_pairs() < proximity.num_pairs() && without.body(a) == pair.bodies[0]);
    CHECK(proximity.without_bodies({a}).num_pairs() < without.num_pairs());
    CHECK(proximity.num_bodies() == links.size() && proximity.body_name(pair.bodies[1]) == b);
    CHECK(thrown([&] { proximity.without({{a, "nothing"}}); }) == URDD_STATUS_UNKNOWN_NAME);
    std::vector<double> few(2);
    std::array<urdd_pair_distance, 1> one{};
    CHECK(thrown([&] { proximity.gradients(urdd::Span<const double>(all.data(), dofs), one, few); }) ==
          URDD_STATUS_LENGTH);
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
    const std::vector<urdd::Obstacle> moved{ball.at(urdd::translation(0.5, 0.0, 0.5))};
    const urdd::Span<const double> first(all.data(), dofs);
    const std::vector<urdd::Obstacle> made{urdd::Obstacle::sphere("ball", {0.5, 0.0, 0.5}, 0.2)};
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
    const urdd::WorldProximity world =
        proximity.world_proximity({urdd::Obstacle::sphere("ball", {0.5, 0.0, 0.5}, 0.2),
                                   urdd::Obstacle::cuboid("floor", urdd::translation(0, 0, -0.06), {2, 2, 0.05})
                                       .ignoring(robot.link_names()[0])});
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
    // A name is not cut at a zero byte.
    const std::string cut("base\0tail", 9);
    CHECK(thrown([&] { robot.link(cut); }) == URDD_STATUS_VALUE);
    CHECK(thrown([&] { urdd::Robot::open(path + cut); }) == URDD_STATUS_VALUE);
    CHECK(thrown([&] { urdd::Obstacle::sphere(cut, {0, 0, 0}, 1); }) == URDD_STATUS_VALUE);
    CHECK(thrown([&] { robot.proximity().without({{cut, cut}}); }) == URDD_STATUS_VALUE);
    CHECK(thrown([&] { urdd::validate(path, cut); }) == URDD_STATUS_VALUE);
    CHECK(thrown([&] { urdd::Obstacle::hull("none", urdd::identity(), {}); }) == URDD_STATUS_VALUE);
    CHECK(thrown([&] { urdd::validate(path, "nonsense"); }) == URDD_STATUS_VALUE);
    CHECK(urdd::validate(path).passes);
}

/// Asks when the variables of the thread that the library has are gone.
struct Farewell {
    ~Farewell() {
        CHECK(thrown([] { urdd::Robot::open("/nowhere"); }) == URDD_STATUS_OPEN);
        std::puts("classes: answered in a static's destructor");
    }
};
const Farewell farewell;

} // namespace

int main(int count, char **words) {
    CHECK(count == 2);
    const urdd::Robot robot = urdd::Robot::open(words[1]);
    kinematics(robot);
    matrices(robot);
    inverse(robot);
    motion(robot);
    distances(robot);
    mistakes(robot, words[1]);
    std::puts("classes: ok");
}
