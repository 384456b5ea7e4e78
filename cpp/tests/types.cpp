// The types of urdd_types.hpp. Every document of the URDDs at or below the given folders is read, and written again to
// the same bytes: what the reference generator wrote is the truth. Built with sanitizers by .ci/cpp.

#include "check.hpp"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iostream>
#include <map>
#include <urdd_types.hpp>

namespace {

using namespace urdd::types;
namespace fs = std::filesystem;

/// What is wrong with a text, as `parse` says it; empty where it is read.
template <class Document> std::string refusal(const std::string &text) {
    try {
        parse<Document>(text);
    } catch (const Error &error) {
        return error.what();
    }
    return "";
}

std::string bytes(const fs::path &path) { return detail::bytes_of(path.string()); }

struct Texts {
    std::string json;
    std::string yaml;
};

template <class Document> Texts again(const std::string &json) {
    const auto document = parse<Document>(json);
    return {json_text(document), yaml_text(document)};
}

using Documents = std::map<std::string, std::function<Texts(const std::string &)>>;

template <class... Modules> Documents documents() { return {{std::string(Modules::module_name), again<Modules>}...}; }

/// Reads each document and writes it again to the same bytes. Counts them by their modules.
void round_trips(const fs::path &folder, std::map<std::string, std::size_t> &counts) {
    const Documents kinds =
        documents<UrdfModule, DofModule, ChainModule, ConnectionsModule, BoundsModule, KinematicsSamplesModule,
                  CompositionModule, NamedConfigurationsModule, OriginalMeshesModule, PlainMeshesModule,
                  ConvexHullMeshesModule, ConvexDecompositionMeshesModule, LinkShapesApproximationsModule,
                  LinkShapesMaxDistanceFromOriginModule, LinkShapesDistanceStatisticsModule,
                  LinkShapesSimpleSkipsModule, LinkShapesSkipsModule, SelfCollisionModelModule>();
    for (const fs::directory_entry &entry : fs::recursive_directory_iterator(folder)) {
        const fs::path &path = entry.path();
        if (path.filename() == "urdd.json") {
            CHECK(json_text(read_file<RootMetadata>(path.string())) == bytes(path));
            ++counts["urdd.json"];
        }
        const auto kind = kinds.find(path.parent_path().filename().string());
        if (path.filename() != "module.json" || kind == kinds.end() ||
            bytes(path.parent_path() / "VERSION").rfind("1.0.0", 0) != 0) {
            continue;
        }
        const std::string json = bytes(path);
        const Texts found = kind->second(json);
        if (found.json != json || found.yaml != bytes(path.parent_path() / "module.yaml")) {
            std::cerr << path << ": is not the same when it is written again\n";
            std::exit(1);
        }
        ++counts[kind->first];
    }
}

void numbers() {
    const auto text = [](double value) { return detail::number(value); };
    // Python's repr, and SPEC 3.3.3.
    CHECK(text(1) == "1.0" && text(-0.0) == "0.0" && text(0.1) == "0.1" && text(-12.5) == "-12.5");
    CHECK(text(1e-4) == "0.0001" && text(1.5e-4) == "0.00015" && text(9.999e-5) == "9.999e-5");
    CHECK(text(1e-5) == "1.0e-5" && text(1e15) == "1000000000000000.0" && text(1e16) == "1.0e+16");
    CHECK(text(1.25e22) == "1.25e+22" && text(123456789012345680.0) == "1.2345678901234568e+17");
    CHECK(text(5e-324) == "5.0e-324" && text(-1.7976931348623157e308) == "-1.7976931348623157e+308");
    CHECK(text(9007199254740993.0) == "9007199254740992.0" && text(5e-5) == "5.0e-5");
    BoundsModule bounds;
    bounds.dof_lower_bounds = {std::nan("")};
    try {
        json_text(bounds);
        CHECK(false);
    } catch (const Error &) {
    }
}

void strings() {
    Generator odd{"a\"\\\n\x01\x7F\xC2\x85\xE2\x80\xA8\xEF\xBB\xBF\xEF\xBF\xBF\xF0\x9F\xA4\x96", "no", nullptr};
    CHECK(json_text(odd) == "{\n  \"name\": \"a\\\"\\\\\\n\\u0001\x7F\xC2\x85\xE2\x80\xA8\xEF\xBB\xBF\xEF\xBF\xBF"
                            "\xF0\x9F\xA4\x96\",\n  \"version\": \"no\"\n}\n");
    CHECK(yaml_text(odd) == "name: \"a\\\"\\\\\\n\\u0001\\u007f\\u0085\\u2028\\ufeff\\uffff\xF0\x9F\xA4\x96\"\n"
                            "version: \"no\"\n");
    odd = {"arm/tool-1.2", "1.0", Json::object({{"x_" + std::string(1000, 'k'), Json::array({1, 1.0, "ON"})}})};
    CHECK(yaml_text(odd) ==
          "name: arm/tool-1.2\nversion: \"1.0\"\n? x_" + std::string(1000, 'k') + "\n: [1, 1.0, \"ON\"]\n");
    CHECK(word(SkipReason::default_) == "Default" && word(JointType::revolute) == "Revolute");
}

/// Keys of later minor versions and of extensions are kept, integers may have a fraction of zero.
void later_versions() {
    const std::string text = R"({"radius": 1, "height": {"of": [1, 2.5]}, "x_mine": null})";
    const auto sphere = parse<Sphere>(text);
    CHECK(sphere.radius == 1 && sphere.extra.at("height").at("of").at(1) == 2.5);
    CHECK(json_text(sphere) ==
          "{\n  \"radius\": 1.0,\n  \"height\": {\n    \"of\": [1, 2.5]\n  },\n  \"x_mine\": null\n}\n");
    CHECK(parse<AngleInput>(R"({"dof_idx": 7.0})").dof_idx == 7);
    const auto geometry = parse<Visual>(R"({"name": null, "origin": null, "material": null,
        "geometry": {"Sphere": {"radius": 2}}})")
                              .geometry;
    CHECK(std::get<SphereGeometry>(geometry.value()).sphere.radius == 2);
}

void bad_input() {
    const auto says = [](const std::string &message, const char *words) {
        return message.find(words) != std::string::npos;
    };
    CHECK(says(refusal<Sphere>("{"), "not JSON"));
    CHECK(says(refusal<Sphere>(""), "not JSON"));
    CHECK(says(refusal<Sphere>("{\"radius\": 1e999}"), "not JSON"));
    CHECK(says(refusal<Sphere>("\xFF"), "not JSON"));
    CHECK(says(refusal<Sphere>("[]"), "the document: an object is wanted here, and this is array"));
    CHECK(says(refusal<Sphere>("{}"), "the key \"radius\" is missing"));
    CHECK(says(refusal<Sphere>(R"({"radius": "1"})"), "at /radius: a number is wanted here, and this is string"));
    CHECK(says(refusal<Sphere>(R"({"radius": null})"), "at /radius"));
    for (const char *index : {"-1", "1.5", "18446744073709551616", "1e300", "true", "null"}) {
        CHECK(says(refusal<AngleInput>("{\"dof_idx\": " + std::string(index) + "}"), "at /dof_idx: an integer"));
    }
    CHECK(says(refusal<Color>(R"({"rgba": [1, 2, 3]})"), "at /rgba: a list of 4"));
    CHECK(says(refusal<Color>(R"({"rgba": [1, 2, 3, {}]})"), "at /rgba/3: a number"));
    CHECK(says(refusal<BoxGeometry>(R"({"Box": {"size": [1, 2]}})"), "at /Box/size"));
    const std::string part = R"({"name": null, "origin": null, "material": null, "geometry": )";
    CHECK(says(refusal<Visual>(part + R"({"Cone": {}}})"), "at /geometry: an object of a kind"));
    CHECK(says(refusal<ModelTestVector>(R"({"configuration": 1, "clearances": []})"), "at /configuration: a list"));
    CHECK(says(refusal<Dof>(R"({"name": "", "joint_idx": 0, "joint_name": "", "quantity": "Mass"})"),
               "at /quantity: unknown word \"Mass\""));
    std::string deep = R"({"base": null, "parts": []})";
    for (int level = 0; level < 300; ++level) {
        deep = R"({"base": null, "parts": [{"id": "", "name": "", "source": {"Urdf": ""}, "prefix": "", "links": [],
            "joints": [], "dropped_links": [], "dropped_joints": [], "frozen_joints": [], "attachment": null,
            "composition": )" +
               deep + "}]}";
    }
    CHECK(says(refusal<CompositionModule>(deep), "too many levels"));
    // Nothing here is recursive before that.
    CHECK(!refusal<Sphere>(std::string(1000000, '[')).empty());
    try {
        read_module<ChainModule>("nowhere");
        CHECK(false);
    } catch (const Error &error) {
        CHECK(says(error.what(), "nowhere/chain_module/VERSION: cannot be read"));
    }
    try {
        read_file<Sphere>("/"); // a folder
        CHECK(false);
    } catch (const Error &error) {
        CHECK(says(error.what(), "/: cannot be read"));
    }
    Sphere twice;
    twice.extra = {{"radius", 1}};
    try {
        json_text(twice);
        CHECK(false);
    } catch (const Error &error) {
        CHECK(says(error.what(), "`extra`"));
    }
}

} // namespace

int main(int count, char **words) {
    numbers();
    strings();
    later_versions();
    bad_input();
    std::map<std::string, std::size_t> counts;
    for (int index = 1; index < count; ++index) {
        round_trips(words[index], counts);
    }
    for (const auto &[name, number] : counts) {
        std::cout << name << ": " << number << "\n";
    }
    CHECK(counts.size() == 19); // urdd.json and every module
}
