// A minimal URDD producer: a URDF in, a URDD of conformance class Core out. The C++ of examples/minimal_producer.py.
//
//     producer robot.urdf out_dir
//
// It repairs nothing: a URDF that has no URDD as it is (SPEC 6.1.3 to 6.1.8), and any with a DOCTYPE, is refused, with
// exit status 1 and nothing at out_dir. Needs nlohmann-json, expat and OpenSSL's libcrypto; not liburdd.

#include "kinematics.hpp"
#include "urdf.hpp"
#include "xml.hpp"

#include <filesystem>
#include <fstream>
#include <iostream>
#include <openssl/evp.h>

namespace fs = std::filesystem;

namespace {

std::string bytes_of(const fs::path &path) {
    std::ifstream file(path, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    demand(file.good(), "cannot be read");
    return bytes;
}

std::string sha256(const std::string &bytes) {
    std::array<unsigned char, 32> hash{};
    demand(EVP_Digest(bytes.data(), bytes.size(), hash.data(), nullptr, EVP_sha256(), nullptr) == 1, "no SHA-256");
    std::string text;
    for (const unsigned char byte : hash) {
        text += "0123456789abcdef"[byte >> 4U];
        text += "0123456789abcdef"[byte & 15U];
    }
    return text;
}

types::FileEntry write(const fs::path &folder, const std::string &path, const std::string &bytes) {
    fs::create_directories((folder / path).parent_path());
    std::ofstream file(folder / path, std::ios::binary);
    file << bytes;
    file.close();
    demand(file.good(), (folder / path).string() + " cannot be written");
    types::FileEntry entry;
    entry.path = path;
    entry.size = bytes.size();
    entry.sha256 = sha256(bytes);
    return entry;
}

template <class Module> types::ModuleEntry write(const fs::path &folder, const Module &module) {
    const std::string path = Module::module_folder;
    types::ModuleEntry entry;
    entry.name = Module::module_name;
    entry.version = Module::module_version;
    entry.path = path;
    entry.depends_on.assign(Module::depends_on.begin(), Module::depends_on.end());
    entry.files = {// In byte order (SPEC 2.7).
                   write(folder, path + "/VERSION", std::string(Module::module_version) + "\n"),
                   write(folder, path + "/module.json", types::json_text(module)),
                   write(folder, path + "/module.yaml", types::yaml_text(module))};
    return entry;
}

/// The file's name, without what no path in a URDD has (SPEC 2.8).
std::string file_name(const fs::path &path) {
    return std::regex_replace(path.filename().string(), std::regex("\xC2[\x80-\x9F]|[\\\\:\x01-\x1f\x7f]"), "_");
}

void produce(const fs::path &source, const fs::path &out) {
    const std::string text = bytes_of(source);
    const types::UrdfModule urdf = urdf_module(*xml::parse(text));
    const types::DofModule dof = dof_module(urdf);
    const types::ChainModule chain = chain_module(urdf);
    const types::BoundsModule bounds = bounds_module(urdf, dof);
    const types::ConnectionsModule connections = connections_module(chain);
    const types::KinematicsSamplesModule samples = kinematics_samples_module(chain, dof, bounds);

    // A folder of our own: nothing is left over in it from another run.
    demand(fs::create_directories(out), out.string() + " is there already");
    types::RootMetadata root;
    root.urdd_version = "1.0.0";
    root.robot_name = urdf.name;
    root.conformance_class = types::ConformanceClass::core;
    root.generator.emplace();
    root.generator->name = "the C++ example of urdd";
    root.generator->version = "1.0.0";
    types::UrdfSource urdf_source;
    urdf_source.urdf = write(out, file_name(source), text);
    root.source = urdf_source;
    root.modules = {write(out, urdf),        write(out, dof),    write(out, chain),
                    write(out, connections), write(out, bounds), write(out, samples)};
    write(out, "urdd.json", types::json_text(root));
}

} // namespace

int main(int count, char **words) {
    if (count != 3) {
        std::cerr << "usage: producer URDF OUT_DIR\n";
        return 2;
    }
    try {
        produce(words[1], words[2]);
    } catch (const std::exception &error) {
        std::cerr << words[1] << ": refused: " << error.what() << "\n";
        return 1;
    }
}
