// Driver: libsdformat 12 (Debian 12.3.0), 14 or 16, sdf::Root::Load of a URDF. Protocol: paths on stdin, JSON lines on stdout.
// A file "loads" if Load returns no error and there is a model (what gz sim asks for before it spawns a model).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <iostream>
#include <sstream>
#include <string>
#include <unistd.h>
#include <utility>
#include <vector>
#include <sdf/sdf.hh>

using std::string;
#if SDF_MAJOR_VERSION < 13
using ignition::math::Pose3d;
static string parent(const sdf::Joint &j) { return j.ParentLinkName(); }
static string child(const sdf::Joint &j) { return j.ChildLinkName(); }
#else
using gz::math::Pose3d;
static string parent(const sdf::Joint &j) { return j.ParentName(); }
static string child(const sdf::Joint &j) { return j.ChildName(); }
#endif

static std::vector<std::pair<string, string>> facts;

static string num(double v) {
    if (v == 0) v = 0;
    char b[40];
    std::snprintf(b, sizeof b, "%.7g", v);
    string s(b);
    if (s == "-nan") s = "nan";
    return s;
}
static string nums(std::initializer_list<double> v) {
    string s;
    for (double x : v) s += (s.empty() ? "" : " ") + num(x);
    return s;
}
static string pose_text(const Pose3d &p) {
    auto q = p.Rot();
    double s = 1;
    if (q.W() < 0 || (q.W() == 0 && (q.X() < 0 || (q.X() == 0 && (q.Y() < 0 || (q.Y() == 0 && q.Z() < 0)))))) s = -1;
    return nums({p.Pos().X(), p.Pos().Y(), p.Pos().Z(), s * q.W(), s * q.X(), s * q.Y(), s * q.Z()});
}
static string json(const string &s) {
    string o = "\"";
    for (size_t i = 0; i < s.size(); ++i) {
        unsigned char c = s[i];
        if (c == '"' || c == '\\') { o += '\\'; o += c; }
        else if (c < 0x20) { char b[8]; std::snprintf(b, sizeof b, "\\u%04x", c); o += b; }
        else if (c < 0x80) o += c;
        else {
            // pass well-formed UTF-8 on, replace the rest
            int n = c >= 0xf0 && c < 0xf5 ? 3 : c >= 0xe0 ? (c < 0xf0 ? 2 : -1) : c >= 0xc2 ? 1 : -1;
            bool ok = n > 0 && i + n < s.size();
            for (int k = 1; ok && k <= n; ++k) ok = (static_cast<unsigned char>(s[i + k]) & 0xc0) == 0x80;
            if (ok) { o += s.substr(i, n + 1); i += n; } else o += "\\ufffd";
        }
    }
    return o + "\"";
}
static void put(const string &k, const string &v) { facts.emplace_back(k, v); }
static string file_of(const string &uri) {
    auto i = uri.find_last_of('/');
    return i == string::npos ? uri : uri.substr(i + 1);
}
static string geometry(const sdf::Geometry *g) {
    if (!g) return "none";
    if (auto b = g->BoxShape()) return "box " + nums({b->Size().X(), b->Size().Y(), b->Size().Z()});
    if (auto c = g->CylinderShape()) return "cylinder " + nums({c->Radius(), c->Length()});
    if (auto s = g->SphereShape()) return "sphere " + num(s->Radius());
    if (auto c = g->CapsuleShape()) return "capsule " + nums({c->Radius(), c->Length()});
    if (auto m = g->MeshShape()) return "mesh " + file_of(m->Uri()) + " " + nums({m->Scale().X(), m->Scale().Y(), m->Scale().Z()});
    return "type" + std::to_string(static_cast<int>(g->Type()));
}

static void collect(const sdf::Model &m) {
    put("robot", m.Name());
    for (uint64_t i = 0; i < m.LinkCount(); ++i) {
        const sdf::Link &l = *m.LinkByIndex(i);
        const string k = "link/" + l.Name();
        put(k, "1");
        put(k + "/inertial", "1");
        const auto &in = l.Inertial();
        put(k + "/inertial/mass", num(in.MassMatrix().Mass()));
        const auto &c = in.Pose().Pos();
        put(k + "/inertial/com", nums({c.X(), c.Y(), c.Z()}));
        const auto moi = in.Moi();  // in the link's axes
        put(k + "/inertial/inertia", nums({moi(0, 0), moi(0, 1), moi(0, 2), moi(1, 1), moi(1, 2), moi(2, 2)}));
        put(k + "/visual", std::to_string(l.VisualCount()));
        for (uint64_t v = 0; v < l.VisualCount(); ++v) {
            const sdf::Visual &s = *l.VisualByIndex(v);
            const string n = k + "/visual/" + std::to_string(v);
            put(n + "/name", s.Name());
            put(n + "/geometry", geometry(s.Geom()));
            put(n + "/origin", pose_text(s.RawPose()));
            if (s.Material()) {
                const auto d = s.Material()->Diffuse();
                put(n + "/color", nums({d.R(), d.G(), d.B(), d.A()}));
            }
        }
        put(k + "/collision", std::to_string(l.CollisionCount()));
        for (uint64_t v = 0; v < l.CollisionCount(); ++v) {
            const sdf::Collision &s = *l.CollisionByIndex(v);
            const string n = k + "/collision/" + std::to_string(v);
            put(n + "/name", s.Name());
            put(n + "/geometry", geometry(s.Geom()));
            put(n + "/origin", pose_text(s.RawPose()));
        }
    }
    for (uint64_t i = 0; i < m.JointCount(); ++i) {
        const sdf::Joint &j = *m.JointByIndex(i);
        const string k = "joint/" + j.Name();
        string t;
        switch (j.Type()) {
            case sdf::JointType::BALL: t = "spherical"; break;
            case sdf::JointType::CONTINUOUS: t = "continuous"; break;
            case sdf::JointType::FIXED: t = "fixed"; break;
            case sdf::JointType::PRISMATIC: t = "prismatic"; break;
            case sdf::JointType::REVOLUTE: t = "revolute"; break;
            case sdf::JointType::SCREW: t = "screw"; break;
            case sdf::JointType::UNIVERSAL: t = "universal"; break;
            default: t = "type" + std::to_string(static_cast<int>(j.Type()));
        }
        put(k, t);
        put(k + "/parent", parent(j));
        put(k + "/child", child(j));
        Pose3d p;
        const string base = parent(j) == "world" ? "__model__" : parent(j);
        if (j.SemanticPose().Resolve(p, base).empty()) put(k + "/origin", pose_text(p));
        if (const sdf::JointAxis *a = j.Axis(0)) {
            put(k + "/axis", nums({a->Xyz().X(), a->Xyz().Y(), a->Xyz().Z()}));
            put(k + "/lower", num(a->Lower()));
            put(k + "/upper", num(a->Upper()));
            put(k + "/effort", num(a->Effort()));
            put(k + "/velocity", num(a->MaxVelocity()));
            put(k + "/damping", num(a->Damping()));
            put(k + "/friction", num(a->Friction()));
#if SDF_MAJOR_VERSION >= 14
            if (auto m = a->Mimic()) put(k + "/mimic", m->Joint() + " " + nums({m->Multiplier(), m->Offset()}));
#endif
        }
    }
    for (uint64_t i = 0; i < m.FrameCount(); ++i) put("frame/" + m.FrameByIndex(i)->Name(), m.FrameByIndex(i)->AttachedTo());
}

int main() {
    char home[] = "/tmp/sdf_home_XXXXXX";
    if (mkdtemp(home)) setenv("HOME", home, 1);
    if (const char *p = getenv("PACKAGES")) setenv("SDF_PATH", p, 1);
    const int out = dup(1);
    char name[] = "/tmp/sdf_log_XXXXXX";
    const int log = mkstemp(name);
    unlink(name);
    dup2(log, 1);
    dup2(log, 2);
    string path;
    while (std::getline(std::cin, path)) {
        if (ftruncate(log, 0) != 0) return 3;
        lseek(log, 0, SEEK_SET);
        facts.clear();
        string why;
        bool loads = false;
        {
            sdf::Root root;
            sdf::Errors errors;
            errors = root.Load(path);  // an exception that Load throws ends a user's program too: no catch
            loads = errors.empty() && root.Model() != nullptr;
            if (!errors.empty()) why = errors.front().Message();
            else if (root.Model() == nullptr) why = "no model";
            if (loads) collect(*root.Model());
        }
        std::cout.flush();
        std::cerr.flush();
        std::vector<string> said;
        lseek(log, 0, SEEK_SET);
        string text;
        char b[4096];
        for (ssize_t n; (n = read(log, b, sizeof b)) > 0;) text.append(b, n);
        std::istringstream ss(text);
        for (string l; std::getline(ss, l);) if (l.find_first_not_of(" \t\r") != string::npos && said.size() < 40) said.push_back(l);
        auto first = why.find('\n');
        if (first != string::npos) why = why.substr(0, first);
        if (!loads && !said.empty()) {
            string s = said[0];
            if (why.rfind("Unable to read file", 0) == 0) why = s;
        }
        std::sort(facts.begin(), facts.end());
        string o = string("{\"verdict\":\"") + (loads ? "loads" : "refuses") + "\",\"why\":" + json(why) + ",\"facts\":{";
        for (size_t i = 0; i < facts.size(); ++i) o += (i ? "," : "") + json(facts[i].first) + ":" + json(facts[i].second);
        o += "},\"said\":[";
        for (size_t i = 0; i < said.size(); ++i) o += (i ? "," : "") + json(said[i]);
        o += "]}\n";
        size_t done = 0;
        while (done < o.size()) {
            ssize_t n = write(out, o.data() + done, o.size() - done);
            if (n <= 0) return 3;
            done += n;
        }
    }
    return 0;
}
