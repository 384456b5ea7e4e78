// Converts a URDF by libsdformat, and prints the SDF: what `gazebo.py` compares with ours.
#include <cstdio>
#include <sdf/sdf.hh>

int main(int argc, char **argv) {
    if (argc != 2) return 2;
    sdf::SDFPtr model(new sdf::SDF());
    sdf::init(model);
    if (!sdf::readFile(argv[1], model)) return 1;
    std::printf("%s", model->Root()->ToString("").c_str());
    return 0;
}
