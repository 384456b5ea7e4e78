// Planning among obstacles by OMPL's RRT-Connect, with urdd or with FCL as the checker, on the same hulls.
//   planning URDD ANSWERS urdd|fcl [QUERIES [CONFIGURATIONS]]
// Prints microseconds for a check of both, and plans a second of one: a process has one sequence of random numbers.
// Writes the answers of both for sampled configurations to ANSWERS (JSON lines), for judge.py.

#include "fcl_checker.hpp"
#include "scene.hpp"

#include <chrono>
#include <functional>
#include <iostream>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/RandomNumbers.h>

namespace ob = ompl::base;
namespace og = ompl::geometric;

namespace {

using Configuration = std::vector<double>;
using Check = std::function<bool(urdd::Span<const double>)>;

double seconds_of(const std::function<void()> &act) {
    const auto start = std::chrono::steady_clock::now();
    act();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct Plans {
    std::size_t solved = 0, checks = 0;
    double seconds = 0;
};

/// A plan for each pair of configurations, by the same random numbers for both checkers.
Plans plan(const urdd::Robot &robot, const std::vector<Configuration> &free, std::size_t queries,
           const Check &collides) {
    const auto dofs = static_cast<unsigned>(robot.num_dofs());
    auto space = std::make_shared<ob::RealVectorStateSpace>(dofs);
    ob::RealVectorBounds bounds(dofs);
    const auto limits = robot.bounds();
    for (unsigned dof = 0; dof < dofs; ++dof) {
        bounds.setLow(dof, limits[dof][0]);
        bounds.setHigh(dof, limits[dof][1]);
    }
    space->setBounds(bounds);
    Plans found;
    for (std::size_t query = 0; query < queries; ++query) {
        og::SimpleSetup setup(space);
        setup.setStateValidityChecker([&](const ob::State *state) {
            ++found.checks;
            return !collides({state->as<ob::RealVectorStateSpace::StateType>()->values, dofs});
        });
        setup.getSpaceInformation()->setStateValidityCheckingResolution(0.005);
        ob::ScopedState<> start(space), goal(space);
        for (unsigned dof = 0; dof < dofs; ++dof) {
            start[dof] = free[2 * query][dof];
            goal[dof] = free[2 * query + 1][dof];
        }
        setup.setStartAndGoalStates(start, goal);
        auto planner = std::make_shared<og::RRTConnect>(setup.getSpaceInformation());
        setup.setPlanner(planner);
        setup.setup();
        std::size_t rounds = 0;
        found.seconds += seconds_of([&] {
            const bool solved = setup.solve(ob::PlannerTerminationCondition([&] { return ++rounds > 20000; })) ==
                                ob::PlannerStatus::EXACT_SOLUTION;
            found.solved += solved ? 1 : 0;
        });
    }
    return found;
}

} // namespace

int main(int count, char **words) {
    const std::string checker = count < 4 ? "" : words[3];
    if (checker != "urdd" && checker != "fcl") {
        std::cerr << "usage: planning URDD ANSWERS urdd|fcl [QUERIES [CONFIGURATIONS]]\n";
        return 2;
    }
    const std::size_t queries = count > 4 ? std::stoul(words[4]) : 50;
    const std::size_t sampled = count > 5 ? std::stoul(words[5]) : 20000;
    ompl::msg::setLogLevel(ompl::msg::LOG_WARN);
    ompl::RNG::setSeed(1);
    const urdd::Robot robot = urdd::Robot::open(words[1]);
    const Scene scene;
    const urdd::Proximity proximity = robot.proximity(urdd::ShapeKind::hulls);
    const urdd::WorldProximity world = proximity.world_proximity(obstacles(scene, robot.link_names().front()));
    FclChecker fcl(robot, proximity, words[1], scene);
    const Check by_urdd = [&](urdd::Span<const double> q) {
        return world.in_collision(q) || proximity.in_collision(q);
    };
    const Check by_fcl = [&](urdd::Span<const double> q) { return fcl.in_collision(q); };

    std::vector<Configuration> configurations, free;
    for (std::uint64_t k = 0; k < sampled || free.size() < 2 * queries; ++k) {
        configurations.push_back(robot.random(k));
        if (free.size() < 2 * queries && !by_urdd(configurations.back()) && !by_fcl(configurations.back())) {
            free.push_back(configurations.back());
        }
    }
    std::vector<bool> ours, theirs;
    const double seconds = seconds_of([&] {
        for (const Configuration &q : configurations) {
            ours.push_back(by_urdd(q));
        }
    });
    const double fcl_seconds = seconds_of([&] {
        for (const Configuration &q : configurations) {
            theirs.push_back(by_fcl(q));
        }
    });
    const auto number = static_cast<double>(configurations.size());
    std::cout << configurations.size() << " configurations, a check: urdd " << 1e6 * seconds / number << " us, FCL "
              << 1e6 * fcl_seconds / number << " us\n";

    std::ofstream answers(words[2]);
    std::size_t apart = 0;
    for (std::size_t k = 0; k < configurations.size(); ++k) {
        apart += ours[k] != theirs[k] ? 1 : 0;
        answers << nlohmann::json{{"q", configurations[k]}, {"urdd", bool(ours[k])}, {"fcl", bool(theirs[k])}}.dump()
                << "\n";
    }
    std::cout << "in " << apart << " their answers differ\n";

    const Plans plans = plan(robot, free, queries, checker == "urdd" ? by_urdd : by_fcl);
    std::cout << checker << ": " << plans.solved << " of " << queries << " planned, "
              << static_cast<double>(plans.solved) / plans.seconds << " plans a second, "
              << 1e6 * plans.seconds / static_cast<double>(plans.checks) << " us for each of " << plans.checks
              << " checks\n";
}
