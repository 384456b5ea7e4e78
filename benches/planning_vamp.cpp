// VAMP's RRT-Connect on the problems of a file, for `planning_problems.py`: PROBLEMS ROBOT ANSWERS. Writes for each a
// line of JSON: whether VAMP's spheres are free at both ends, milliseconds of processor time (the least of three rounds
// of the same samples), and the path. The settings are those of VAMP's Python package. One thread.

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include <vamp/collision/factory.hh>
#include <vamp/planning/rrtc.hh>
#include <vamp/random/halton.hh>
#include <vamp/robots/fetch.hh>
#include <vamp/robots/panda.hh>

namespace factory = vamp::collision::factory;
namespace planning = vamp::planning;

double milliseconds() {
    timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e3 * now.tv_sec + 1e-6 * now.tv_nsec;
}

template <class Robot>
void solve(std::istream &problems, std::ostream &answers, float range) {
    using Configuration = typename Robot::Configuration;
    using World = vamp::collision::Environment<vamp::FloatVector<8>>;
    vamp::collision::Environment<float> around;
    Configuration start, goal;
    auto row = [](std::istream &words) {
        alignas(32) float numbers[Configuration::num_scalars_rounded] = {0};
        for (std::size_t k = 0; k < Robot::dimension; k++) words >> numbers[k];
        return Configuration(numbers);
    };
    for (std::string line; std::getline(problems, line);) {
        std::istringstream words(line);
        std::string kind;
        words >> kind;
        if (kind == "problem") around = {};
        if (kind == "start") start = row(words);
        if (kind == "goal") goal = row(words);
        std::array<float, 9> b{};
        if (kind == "box") {
            for (float &number : b) words >> number;
            auto box = factory::cuboid::array({b[0], b[1], b[2]}, {b[3], b[4], b[5]}, {b[6], b[7], b[8]});
            (box.axis_3_z == 1.0F ? around.z_aligned_cuboids : around.cuboids).push_back(box);
        }
        if (kind == "capsule") {
            for (std::size_t k = 0; k < 8; k++) words >> b[k];
            auto one = factory::cylinder::center::array({b[0], b[1], b[2]}, {b[3], b[4], b[5]}, b[6], b[7]);
            (one.xv == 0 && one.yv == 0 ? around.z_aligned_capsules : around.capsules).emplace_back(one);
        }
        if (kind != "end") continue;
        around.sort();
        const World world(around);
        auto is_free = [&](const Configuration &q) { return planning::validate_motion<Robot, 8, 1>(q, q, world); };
        double least = 1e9;
        planning::PlanningResult<Robot> found;
        for (int round = 0; round < 3; round++) {
            auto samples = std::make_shared<vamp::rng::Halton<Robot>>();
            planning::RRTCSettings settings;
            settings.range = range;
            const double begin = milliseconds();
            found = planning::RRTC<Robot, 8, Robot::resolution>::solve(start, goal, world, settings, samples);
            least = std::min(least, milliseconds() - begin);
        }
        answers << "{\"free\": " << (is_free(start) && is_free(goal)) << ", \"ms\": " << least << ", \"path\": [";
        for (std::size_t k = 0; k < found.path.size(); k++) {
            answers << (k ? ", [" : "[");
            for (std::size_t joint = 0; joint < Robot::dimension; joint++) {
                char number[32];
                std::snprintf(number, sizeof number, "%s%.9g", joint ? ", " : "", found.path[k][{0, joint}]);
                answers << number;
            }
            answers << "]";
        }
        answers << "]}\n";
    }
}

int main(int, char **words) {
    std::ifstream problems(words[1]);
    std::ofstream answers(words[3]);
    const std::string robot = words[2];
    if (robot == "panda") solve<vamp::robots::Panda>(problems, answers, 1.0F);
    if (robot == "fetch") solve<vamp::robots::Fetch>(problems, answers, 1.0F);
}
