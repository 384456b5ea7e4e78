// Poses and Jacobians by Pinocchio's C++, beside `cargo bench --bench kinematics`. All of it comes from the headers, so
// that it is compiled for the machine, and with one Eigen.
//
//   apt-get install g++ libeigen3-dev && python3 -m venv /tmp/peers && /tmp/peers/bin/pip install pin
//   P=$(/tmp/peers/bin/python -c "import pinocchio; print(pinocchio.__file__.split('/pinocchio/')[0])")/cmeel.prefix
//   g++ -std=c++17 -O3 -march=native -DNDEBUG -DBOOST_MPL_LIMIT_LIST_SIZE=30 -DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS
//       -I$P/include -I/usr/include/eigen3 benches/kinematics_pinocchio.cpp
//       -L$P/lib -Wl,-rpath,$P/lib -lboost_serialization -o /tmp/kinematics_pinocchio
//   /tmp/peers/bin/python -c "import pinocchio, sys; pinocchio.buildModelFromUrdf(*sys.argv[1:2], mimic=True)
//       .saveToText(sys.argv[2])" ROBOT.urdf /tmp/model.txt
//   /tmp/kinematics_pinocchio LINK /tmp/model.txt
//
// LINK is the link of the Jacobian; the Rust bench prints which it takes. For 10,000 random configurations within
// bounds it prints the median of five rounds, microseconds for a configuration, one thread: the poses of joints alone
// (`forwardKinematics`), of joints and links (`framesForwardKinematics`), and the Jacobian of the link
// (`computeFrameJacobian`, along the axes of the world).

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

#include <pinocchio/algorithm/frames.hpp>
#include <pinocchio/algorithm/joint-configuration.hpp>
#include <pinocchio/algorithm/kinematics.hpp>
#include <pinocchio/serialization.hpp>

namespace {

constexpr int kConfigurations = 10000;
constexpr int kRounds = 5;

template <typename Run>
void Row(const char* what, const std::vector<Eigen::VectorXd>& all, Run run) {
  std::vector<double> times;
  for (int round = 0; round < kRounds; ++round) {
    const auto start = std::chrono::steady_clock::now();
    for (const auto& q : all) run(q);
    const std::chrono::duration<double, std::micro> time = std::chrono::steady_clock::now() - start;
    times.push_back(time.count() / kConfigurations);
  }
  std::sort(times.begin(), times.end());
  std::printf("    %-42s %9.3f us\n", what, times[kRounds / 2]);
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) {
    std::fprintf(stderr, "usage: kinematics_pinocchio LINK MODEL.txt\n");
    return 2;
  }
  const std::string link = arguments[1], file = arguments[2];
  pinocchio::Model model;
  model.loadFromText(file);
  if (!model.existFrame(link)) {
    std::fprintf(stderr, "there is no link %s\n", link.c_str());
    return 2;
  }
  const auto frame = model.getFrameId(link);
  pinocchio::Data data(model);
  // Joints without limits: a turn, a metre.
  Eigen::VectorXd lower = model.lowerPositionLimit, upper = model.upperPositionLimit;
  for (Eigen::Index i = 0; i < lower.size(); ++i) {
    if (!(lower[i] > -1e3)) lower[i] = -1;
    if (!(upper[i] < 1e3)) upper[i] = 1;
  }
  std::vector<Eigen::VectorXd> all;
  for (int k = 0; k < kConfigurations; ++k) {
    all.push_back(pinocchio::randomConfiguration(model, lower, upper));
  }
  pinocchio::Data::Matrix6x jacobian = pinocchio::Data::Matrix6x::Zero(6, model.nv);
  double sum = 0;
  std::printf("%s: %d joints, %d frames, by Pinocchio's C++\n", file.c_str(), model.njoints, model.nframes);
  Row("poses of joints", all, [&](const Eigen::VectorXd& q) {
    pinocchio::forwardKinematics(model, data, q);
    sum += data.oMi[model.njoints - 1].translation()[0];
  });
  Row("poses of joints and links", all, [&](const Eigen::VectorXd& q) {
    pinocchio::framesForwardKinematics(model, data, q);
    sum += data.oMf[frame].translation()[0];
  });
  Row(("Jacobian of " + link).c_str(), all, [&](const Eigen::VectorXd& q) {
    jacobian.setZero();
    pinocchio::computeFrameJacobian(model, data, q, frame, pinocchio::LOCAL_WORLD_ALIGNED, jacobian);
    sum += jacobian(0, 0);
  });
  std::fprintf(stderr, "%g\n", sum);
  return 0;
}
