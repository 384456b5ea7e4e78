// Loads an SDF with libsdformat, and prints mass and pose of each link at zero, in the model: what `peers.py` compares.
// With `joints` after the file, it prints the names of the joints that are not fixed: what `order.py` compares.
#include <cstdio>
#include <iomanip>
#include <sstream>
#include <sdf/sdf.hh>

int main(int argc, char **argv) {
    if (argc != 2 && argc != 3) return 2;
    sdf::Root root;
    const sdf::Errors errors = root.Load(argv[1]);
    for (const sdf::Error &error : errors) std::fprintf(stderr, "%s\n", error.Message().c_str());
    if (!errors.empty() || root.Model() == nullptr) return 1;
    const sdf::Model &model = *root.Model();
    if (argc == 3) {
        for (uint64_t i = 0; i < model.JointCount(); ++i) {
            const sdf::Joint &joint = *model.JointByIndex(i);
            if (joint.Type() != sdf::JointType::FIXED) std::printf("%s\n", joint.Name().c_str());
        }
        return 0;
    }
    for (uint64_t i = 0; i < model.LinkCount(); ++i) {
        const sdf::Link &link = *model.LinkByIndex(i);
        ignition::math::Pose3d pose;
        if (!link.SemanticPose().Resolve(pose, "__model__").empty()) return 1;
        const auto &p = pose.Pos();
        const auto &q = pose.Rot();
        std::ostringstream name;
        name << std::quoted(link.Name());
        std::printf("{\"link\": %s, \"mass\": %.17g, \"pose\": [%.17g, %.17g, %.17g, %.17g, %.17g, %.17g, %.17g], \"collisions\": %lu}\n",
                    name.str().c_str(), link.Inertial().MassMatrix().Mass(), p.X(), p.Y(), p.Z(), q.W(), q.X(), q.Y(), q.Z(),
                    static_cast<unsigned long>(link.CollisionCount()));
    }
    return 0;
}
