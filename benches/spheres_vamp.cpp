// VAMP's checks, for `benches/spheres_vamp.py`: FOLDER ROBOT KIND. Writes its answers beside the inputs, one byte each, and
// prints microseconds for a configuration and for a motion, free and blocked: the least of nine rounds, one thread.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <vamp/collision/factory.hh>
#include <vamp/planning/validate.hh>
#include <vamp/robots/baxter.hh>
#include <vamp/robots/fetch.hh>
#include <vamp/robots/panda.hh>
#include <vamp/robots/ur5.hh>
#include <vamp/vector.hh>

using World = vamp::collision::Environment<vamp::FloatVector<8>>;

std::vector<float> read(const std::string &path) {
    std::ifstream file(path, std::ios::binary);
    std::vector<char> bytes((std::istreambuf_iterator<char>(file)), {});
    std::vector<double> numbers(bytes.size() / sizeof(double));
    std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(double));
    return {numbers.begin(), numbers.end()};
}

template <class Ask>
double microseconds(const std::vector<int> &asked, Ask ask) {
    if (asked.empty()) return 0.0;
    double least = 1e9;
    std::size_t rounds = std::max<std::size_t>(1, 20000 / asked.size()), found = 0;
    for (int k = 0; k < 9; k++) {
        auto start = std::chrono::steady_clock::now();
        for (std::size_t round = 0; round < rounds; round++)
            for (int one : asked) found += ask(one);
        std::chrono::duration<double, std::micro> spent = std::chrono::steady_clock::now() - start;
        least = std::min(least, spent.count() / (rounds * asked.size()));
    }
    volatile std::size_t kept = found;
    (void)kept;
    return least;
}

template <class Robot>
void measure(const std::string &folder, const std::string &robot, const std::string &kind) {
    using Configuration = typename Robot::Configuration;
    vamp::collision::Environment<float> around;
    if (kind == "boxes") {
        auto boxes = read(folder + "/boxes.bin");
        for (std::size_t k = 0; k + 9 <= boxes.size(); k += 9) {
            const float *b = &boxes[k];
            around.cuboids.emplace_back(
                vamp::collision::factory::cuboid::array({b[0], b[1], b[2]}, {b[3], b[4], b[5]}, {b[6], b[7], b[8]}));
        }
        around.sort();
    } else if (kind != "self") {
        auto numbers = read(folder + "/" + kind + ".bin");
        std::vector<vamp::collision::Point> points;
        for (std::size_t k = 0; k < numbers.size(); k += 3) points.push_back({numbers[k], numbers[k + 1], numbers[k + 2]});
        auto start = std::chrono::steady_clock::now();
        around.pointclouds.emplace_back(points, Robot::min_radius, Robot::max_radius, 0.005f);
        std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - start;
        std::printf("vamp  %s %s: tree in %.1f ms\n", robot.c_str(), kind.c_str(), spent.count());
    }
    World world(around);
    auto rows = [&](const std::string &path) {
        auto numbers = read(path);
        std::vector<Configuration> all;
        for (std::size_t k = 0; k < numbers.size(); k += Robot::dimension) {
            alignas(32) float row[Configuration::num_scalars_rounded] = {0};
            std::copy_n(&numbers[k], Robot::dimension, row);
            all.emplace_back(row);
        }
        return all;
    };
    auto asked = rows(folder + "/" + robot + "_q.bin"), ends = rows(folder + "/" + robot + "_e.bin");
    auto touches = [&](int k) { return !vamp::planning::validate_motion<Robot, 8, 1>(asked[k], asked[k], world); };
    auto blocked = [&](int k) { return !vamp::planning::validate_motion<Robot, 8, 32>(ends[2 * k], ends[2 * k + 1], world); };
    auto answer = [&](std::size_t count, auto ask, const std::string &path) {
        std::vector<int> found[2];
        std::vector<char> answers(count);
        for (std::size_t k = 0; k < count; k++) {
            answers[k] = ask(k);
            found[answers[k]].push_back(k);
        }
        std::ofstream(path, std::ios::binary).write(answers.data(), count);
        return std::pair(microseconds(found[0], ask), microseconds(found[1], ask));
    };
    auto base = folder + "/" + robot + "_" + kind;
    auto [free, colliding] = answer(asked.size(), touches, base + "_q.answers");
    auto [open, closed] = answer(ends.size() / 2, blocked, base + "_e.answers");
    std::printf("vamp  %s %s: free %.3f, colliding %.3f; motions free %.3f, blocked %.3f\n", robot.c_str(), kind.c_str(), free,
                colliding, open, closed);
}

int main(int, char **words) {
    std::string folder = words[1], robot = words[2], kind = words[3];
    if (robot == "panda") measure<vamp::robots::Panda>(folder, robot, kind);
    if (robot == "ur5") measure<vamp::robots::UR5>(folder, robot, kind);
    if (robot == "fetch") measure<vamp::robots::Fetch>(folder, robot, kind);
    if (robot == "baxter") measure<vamp::robots::Baxter>(folder, robot, kind);
}
