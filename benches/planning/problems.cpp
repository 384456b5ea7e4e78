// Solves the problems of a file by OMPL's RRT-Connect, with urdd or with FCL as the checker, on the same hulls.
//   problems PROBLEMS URDD ANSWERS urdd|fcl
// PROBLEMS and ANSWERS are those of ../planning_problems.py. Writes for each problem a line of JSON: whether both ends
// are free, milliseconds of processor time, and the path; no path after ten seconds. Motions are checked at 1/32 rad.

#include "fcl_checker.hpp"
#include "scene.hpp"

#include <ctime>
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

constexpr double RANGE = 1.0, RESOLUTION = 1.0 / 32, MOST_MILLISECONDS = 1e4;

double milliseconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

struct Problem {
    Configuration start, goal;
    Scene scene{{}, {}, {}, false};
};

std::vector<double> numbers(std::istream &words) {
    std::vector<double> found;
    for (double one = 0; words >> one;) {
        found.push_back(one);
    }
    return found;
}

std::vector<Problem> read(const std::string &path) {
    std::vector<Problem> found;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string kind;
        words >> kind;
        if (kind == "problem") {
            found.emplace_back();
            continue;
        }
        const std::vector<double> n = numbers(words);
        if (kind == "start" || kind == "goal") {
            (kind == "start" ? found.back().start : found.back().goal) = n;
        } else if (kind == "box") {
            found.back().scene.boxes.push_back({{n[0], n[1], n[2]}, {n[6], n[7], n[8]}, {n[3], n[4], n[5]}});
        } else if (kind == "capsule") {
            found.back().scene.capsules.push_back({{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, n[6], n[7] / 2});
        }
    }
    return found;
}

nlohmann::json solve(const urdd::Robot &robot, const Problem &problem, const Check &collides) {
    const auto dofs = static_cast<unsigned>(robot.num_dofs());
    auto space = std::make_shared<ob::RealVectorStateSpace>(dofs);
    ob::RealVectorBounds bounds(dofs);
    const auto limits = robot.bounds();
    for (unsigned dof = 0; dof < dofs; ++dof) {
        bounds.setLow(dof, std::min({limits[dof][0], problem.start[dof], problem.goal[dof]}));
        bounds.setHigh(dof, std::max({limits[dof][1], problem.start[dof], problem.goal[dof]}));
    }
    space->setBounds(bounds);
    og::SimpleSetup setup(space);
    setup.setStateValidityChecker([&](const ob::State *state) {
        return !collides({state->as<ob::RealVectorStateSpace::StateType>()->values, dofs});
    });
    setup.getSpaceInformation()->setStateValidityCheckingResolution(RESOLUTION / space->getMaximumExtent());
    ob::ScopedState<> start(space), goal(space);
    for (unsigned dof = 0; dof < dofs; ++dof) {
        start[dof] = problem.start[dof];
        goal[dof] = problem.goal[dof];
    }
    setup.setStartAndGoalStates(start, goal);
    auto planner = std::make_shared<og::RRTConnect>(setup.getSpaceInformation());
    planner->setRange(RANGE);
    setup.setPlanner(planner);
    setup.setup();
    const bool free = !collides(problem.start) && !collides(problem.goal);
    nlohmann::json path = nlohmann::json::array();
    const double begin = milliseconds();
    const bool solved = free && setup.solve(ob::PlannerTerminationCondition([&] {
        return milliseconds() - begin > MOST_MILLISECONDS;
    })) == ob::PlannerStatus::EXACT_SOLUTION;
    const double spent = milliseconds() - begin;
    if (solved) {
        for (const ob::State *state : setup.getSolutionPath().getStates()) {
            const double *q = state->as<ob::RealVectorStateSpace::StateType>()->values;
            path.push_back(Configuration(q, q + dofs));
        }
    }
    return {{"free", free ? 1 : 0}, {"ms", spent}, {"path", path}};
}

} // namespace

int main(int count, char **words) {
    const std::string checker = count < 5 ? "" : words[4];
    if (checker != "urdd" && checker != "fcl") {
        std::cerr << "usage: problems PROBLEMS URDD ANSWERS urdd|fcl\n";
        return 2;
    }
    ompl::msg::setLogLevel(ompl::msg::LOG_ERROR);
    ompl::RNG::setSeed(1);
    const urdd::Robot robot = urdd::Robot::open(words[2]);
    const urdd::Proximity proximity = robot.proximity(urdd::ShapeKind::hulls);
    std::ofstream answers(words[3]);
    for (const Problem &problem : read(words[1])) {
        const auto world = proximity.world_proximity(obstacles(problem.scene, robot.link_names().front()));
        FclChecker fcl(robot, proximity, words[2], problem.scene);
        const Check by_urdd = [&](urdd::Span<const double> q) {
            return world.in_collision(q) || proximity.in_collision(q);
        };
        const Check by_fcl = [&](urdd::Span<const double> q) { return fcl.in_collision(q); };
        answers << solve(robot, problem, checker == "urdd" ? by_urdd : by_fcl).dump() << "\n";
    }
}
