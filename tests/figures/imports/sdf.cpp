// libsdformat 12: what a model is once all names are resolved, as a line of JSON for each path on stdin.
// g++ -O1 -o /tmp/sdf_truth sdf.cpp $(pkg-config --cflags --libs sdformat12)
#include <cmath>
#include <cstdio>
#include <fcntl.h>
#include <iostream>
#include <sstream>
#include <string>
#include <unistd.h>
#include <sdf/sdf.hh>

using ignition::math::Pose3d;
using std::string;

static string out;
static string failed;

static string js(const string &s) {
    string o = "\"";
    for (unsigned char c : s) {
        char b[8];
        if (c == '"' || c == '\\') { o += '\\'; o += c; }
        else if (c < 0x20) { std::snprintf(b, sizeof b, "\\u%04x", c); o += b; }
        else o += c;
    }
    return o + "\"";
}
static string number(double v) {
    if (!std::isfinite(v)) return "null";
    char b[40];
    std::snprintf(b, sizeof b, "%.17g", v);
    return b;
}
static string list(std::initializer_list<double> values) {
    string o = "[";
    for (double v : values) o += (o.size() > 1 ? "," : "") + number(v);
    return o + "]";
}
static string pose(const Pose3d &p) {
    return list({p.Pos().X(), p.Pos().Y(), p.Pos().Z(), p.Rot().W(), p.Rot().X(), p.Rot().Y(), p.Rot().Z()});
}
static void check(const sdf::Errors &errors) {
    if (!errors.empty() && failed.empty()) failed = errors.front().Message();
}
static string geometry(const sdf::Geometry *g) {
    if (!g) return "[\"none\"]";
    if (auto b = g->BoxShape()) return "[\"box\"," + list({b->Size().X(), b->Size().Y(), b->Size().Z()}) + "]";
    if (auto c = g->CylinderShape()) return "[\"cylinder\"," + list({c->Radius(), c->Length()}) + "]";
    if (auto s = g->SphereShape()) return "[\"sphere\"," + list({s->Radius()}) + "]";
    if (auto c = g->CapsuleShape()) return "[\"capsule\"," + list({c->Radius(), c->Length()}) + "]";
    if (auto e = g->EllipsoidShape()) return "[\"ellipsoid\"," + list({e->Radii().X(), e->Radii().Y(), e->Radii().Z()}) + "]";
    if (auto m = g->MeshShape())
        return "[\"mesh\"," + list({m->Scale().X(), m->Scale().Y(), m->Scale().Z()}) + "," + js(m->Uri()) + "," + js(m->Submesh()) + "]";
    return "[\"other\"]";
}
template <class Shape>
static string shape(const Shape &s) {
    Pose3d p;
    check(s.SemanticPose().Resolve(p));
    return "{\"pose\":" + pose(p) + ",\"geometry\":" + geometry(s.Geom()) + "}";
}

static void model(const sdf::Model &m, const sdf::Model &root, const string &prefix, string &links, string &joints, string &frames) {
    auto comma = [](string &s) { if (!s.empty()) s += ','; };
    // The pose of a node of this model in the root: by way of the nested model's own.
    auto of_root = [&](const sdf::SemanticPose &p) {
        Pose3d inside, around;
        check(p.Resolve(inside, "__model__"));
        string rest = prefix;
        if (!rest.empty()) {
            rest = rest.substr(0, rest.size() - 2);
            const sdf::Model *nested = root.ModelByName(rest);
            // ModelByName takes nested names; each pose is in its parent's frame.
            string name = rest;
            while (nested) {
                Pose3d own;
                check(nested->SemanticPose().Resolve(own, "__model__"));
                around = own * around;
                auto at = name.rfind("::");
                if (at == string::npos) break;
                name = name.substr(0, at);
                nested = root.ModelByName(name);
            }
        }
        return around * inside;
    };
    for (uint64_t i = 0; i < m.LinkCount(); ++i) {
        const sdf::Link &l = *m.LinkByIndex(i);
        const auto &in = l.Inertial();
        const auto moi = in.Moi();
        const auto c = in.Pose().Pos();
        string visuals, collisions;
        for (uint64_t k = 0; k < l.VisualCount(); ++k) { comma(visuals); visuals += shape(*l.VisualByIndex(k)); }
        for (uint64_t k = 0; k < l.CollisionCount(); ++k) { comma(collisions); collisions += shape(*l.CollisionByIndex(k)); }
        comma(links);
        links += js(prefix + l.Name()) + ":{\"pose\":" + pose(of_root(l.SemanticPose())) + ",\"mass\":" + number(in.MassMatrix().Mass())
            + ",\"centre\":" + list({c.X(), c.Y(), c.Z()})
            + ",\"inertia\":" + list({moi(0, 0), moi(0, 1), moi(0, 2), moi(1, 1), moi(1, 2), moi(2, 2)})
            + ",\"visuals\":[" + visuals + "],\"collisions\":[" + collisions + "]}";
    }
    for (uint64_t i = 0; i < m.JointCount(); ++i) {
        const sdf::Joint &j = *m.JointByIndex(i);
        string parent, child, axes;
        check(j.ResolveParentLink(parent));
        check(j.ResolveChildLink(child));
        Pose3d p;
        check(j.SemanticPose().Resolve(p, "__model__"));
        for (int k = 0; k < 2; ++k) {
            const sdf::JointAxis *a = j.Axis(k);
            if (!a) continue;
            ignition::math::Vector3d xyz;
            check(a->ResolveXyz(xyz));
            comma(axes);
            axes += "{\"xyz\":" + list({xyz.X(), xyz.Y(), xyz.Z()}) + ",\"lower\":" + number(a->Lower()) + ",\"upper\":" + number(a->Upper())
                + ",\"effort\":" + number(a->Effort()) + ",\"velocity\":" + number(a->MaxVelocity())
                + ",\"damping\":" + number(a->Damping()) + ",\"friction\":" + number(a->Friction()) + "}";
        }
        comma(joints);
        joints += js(prefix + j.Name()) + ":{\"type\":" + std::to_string(static_cast<int>(j.Type()))
            + ",\"parent\":" + js(parent == "world" ? parent : prefix + parent) + ",\"child\":" + js(prefix + child)
            + ",\"pose\":" + pose(of_root(j.SemanticPose())) + ",\"pitch\":" + number(j.Type() == sdf::JointType::SCREW ? -2 * M_PI / j.ThreadPitch() : 0)
            + ",\"axes\":[" + axes + "]}";
    }
    for (uint64_t i = 0; i < m.FrameCount(); ++i) {
        const sdf::Frame &f = *m.FrameByIndex(i);
        string body;
        check(f.ResolveAttachedToBody(body));
        comma(frames);
        frames += js(prefix + f.Name()) + ":{\"pose\":" + pose(of_root(f.SemanticPose())) + ",\"link\":" + js(prefix + body) + "}";
    }
    for (uint64_t i = 0; i < m.ModelCount(); ++i) {
        const sdf::Model &n = *m.ModelByIndex(i);
        model(n, root, prefix + n.Name() + "::", links, joints, frames);
    }
}

int main() {
    const int to = dup(1);
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, 1);
    dup2(nowhere, 2);
    for (string path; std::getline(std::cin, path);) {
        failed.clear();
        sdf::Root root;
        check(root.Load(path));
        const sdf::Model *m = root.Model();
        if (!m && root.WorldCount() > 0) {
            // The only one that is not static, as an import chooses.
            const sdf::World &w = *root.WorldByIndex(0);
            for (uint64_t i = 0, n = 0; i < w.ModelCount(); ++i) {
                const sdf::Model *one = w.ModelByIndex(i);
                if (w.ModelCount() == 1 || !one->Static()) m = n++ ? nullptr : one;
            }
        }
        string line;
        if (!m) line = "{\"error\":" + js(failed.empty() ? "no model" : failed) + "}";
        else {
            string links, joints, frames;
            model(*m, *m, "", links, joints, frames);
            line = "{\"error\":" + (failed.empty() ? string("null") : js(failed)) + ",\"name\":" + js(m->Name()) + ",\"static\":" + (m->Static() ? "true" : "false")
                + ",\"links\":{" + links + "},\"joints\":{" + joints + "},\"frames\":{" + frames + "}}";
        }
        line += "\n";
        for (size_t done = 0; done < line.size();) {
            ssize_t n = write(to, line.data() + done, line.size() - done);
            if (n <= 0) return 3;
            done += n;
        }
    }
}
