// Driver: urdfdom (urdf::parseURDFFile, what every ROS program calls in the end).
// `install` builds it for 6.0.0; with -DOLD for 4.0.1, and for Debian's 3.0.1, of which ROS humble has 3.0.2.
#include <console_bridge/console.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <map>
#include <string>
#include <unistd.h>
#include <vector>

static std::vector<std::string> said;
struct Keep : console_bridge::OutputHandler {
  void log(const std::string &text, console_bridge::LogLevel level, const char *, int) override {
    std::string t = text;
    for (auto &c : t) if (c == '\n' || c == '\r') c = ' ';
    said.push_back((level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR ? "Error: " : level == console_bridge::CONSOLE_BRIDGE_LOG_WARN ? "Warning: " : "Info: ") + t);
  }
};
static std::string num(double v) {
  if (std::isnan(v)) return "nan";
  if (v == 0) v = 0;
  char b[40];
  snprintf(b, sizeof b, "%.7g", v == 0 ? 0.0 : v);
  return b;
}
static std::string nums(std::initializer_list<double> l) {
  std::string s;
  for (double v : l) s += (s.empty() ? "" : " ") + num(v);
  return s;
}
static std::string pose(const urdf::Pose &p) {
  double x = p.rotation.x, y = p.rotation.y, z = p.rotation.z, w = p.rotation.w;
  if (w < 0 || (w == 0 && (x < 0 || (x == 0 && (y < 0 || (y == 0 && z < 0)))))) { x = -x; y = -y; z = -z; w = -w; }
  return nums({p.position.x, p.position.y, p.position.z, w, x, y, z});
}
static std::string quote(const std::string &s) {
  std::string o = "\"";
  for (size_t i = 0; i < s.size();) {
    unsigned char c = s[i];
    if (c == '"' || c == '\\') { o += '\\'; o += c; i++; continue; }
    if (c < 0x20 || c == 0x7f) { char b[8]; snprintf(b, sizeof b, "\\u%04x", c); o += b; i++; continue; }
    if (c < 0x80) { o += c; i++; continue; }
    size_t n = c >= 0xf0 && c < 0xf5 ? 4 : c >= 0xe0 && c < 0xf0 ? 3 : c >= 0xc2 && c < 0xe0 ? 2 : 0;
    bool ok = n && i + n <= s.size();
    for (size_t k = 1; ok && k < n; k++) ok = ((unsigned char)s[i + k] & 0xc0) == 0x80;
    if (ok && c == 0xe0 && (unsigned char)s[i + 1] < 0xa0) ok = false;
    if (ok && c == 0xed && (unsigned char)s[i + 1] > 0x9f) ok = false;
    if (ok && c == 0xf0 && (unsigned char)s[i + 1] < 0x90) ok = false;
    if (ok && c == 0xf4 && (unsigned char)s[i + 1] > 0x8f) ok = false;
    if (ok) { o += s.substr(i, n); i += n; } else { o += "\\ufffd"; i++; }
  }
  return o + "\"";
}
using Facts = std::map<std::string, std::string>;
static void geometry(Facts &f, const std::string &k, const urdf::GeometrySharedPtr &g) {
  if (!g) return;
  switch (g->type) {
    case urdf::Geometry::SPHERE: f[k] = "sphere " + num(static_cast<urdf::Sphere &>(*g).radius); break;
    case urdf::Geometry::BOX: { auto &d = static_cast<urdf::Box &>(*g).dim; f[k] = "box " + nums({d.x, d.y, d.z}); break; }
    case urdf::Geometry::CYLINDER: { auto &c = static_cast<urdf::Cylinder &>(*g); f[k] = "cylinder " + nums({c.radius, c.length}); break; }
    case urdf::Geometry::MESH: { auto &m = static_cast<urdf::Mesh &>(*g); f[k] = "mesh " + m.filename + " " + nums({m.scale.x, m.scale.y, m.scale.z}); break; }
#ifndef OLD
    case urdf::Geometry::CAPSULE: { auto &c = static_cast<urdf::Capsule &>(*g); f[k] = "capsule " + nums({c.radius, c.length}); break; }
#endif
  }
}
int main() {
  std::ios::sync_with_stdio(false);
  FILE *out = fdopen(dup(1), "w");
  if (!freopen("/dev/null", "w", stdout)) return 1;
  Keep keep;
  console_bridge::useOutputHandler(&keep);
  std::string path;
  while (std::getline(std::cin, path)) {
    said.clear();
    Facts f;
    urdf::ModelInterfaceSharedPtr m;
    std::string why;
    try { m = urdf::parseURDFFile(path); }
    catch (const std::exception &e) { why = std::string("exception: ") + e.what(); }
    if (m) {
      f["robot"] = m->getName();
      if (m->getRoot()) f["root"] = m->getRoot()->name;
      for (auto &p : m->materials_) {
        auto &c = p.second->color;
        f["material/" + p.first] = nums({c.r, c.g, c.b, c.a});
        if (!p.second->texture_filename.empty()) f["material/" + p.first + "/texture"] = p.second->texture_filename;
      }
      for (auto &p : m->links_) {
        std::string k = "link/" + p.first;
        auto &l = *p.second;
        f[k] = "1";
        if (l.inertial) {
          auto &i = *l.inertial;
          f[k + "/inertial"] = "1";
          f[k + "/inertial/mass"] = num(i.mass);
          auto &o = i.origin.position;
          f[k + "/inertial/com"] = nums({o.x, o.y, o.z});
          double q[4], R[3][3], I[3][3] = {{i.ixx, i.ixy, i.ixz}, {i.ixy, i.iyy, i.iyz}, {i.ixz, i.iyz, i.izz}}, T[3][3], J[3][3];
          i.origin.rotation.getQuaternion(q[0], q[1], q[2], q[3]);
          double x = q[0], y = q[1], z = q[2], w = q[3];
          R[0][0] = 1 - 2 * (y * y + z * z); R[0][1] = 2 * (x * y - w * z); R[0][2] = 2 * (x * z + w * y);
          R[1][0] = 2 * (x * y + w * z); R[1][1] = 1 - 2 * (x * x + z * z); R[1][2] = 2 * (y * z - w * x);
          R[2][0] = 2 * (x * z - w * y); R[2][1] = 2 * (y * z + w * x); R[2][2] = 1 - 2 * (x * x + y * y);
          if (x == 0 && y == 0 && z == 0) {
            for (int a = 0; a < 3; a++) for (int b = 0; b < 3; b++) J[a][b] = I[a][b];
          } else {
            for (int a = 0; a < 3; a++) for (int b = 0; b < 3; b++) { T[a][b] = 0; for (int c = 0; c < 3; c++) T[a][b] += R[a][c] * I[c][b]; }
            double big = 0;
            for (int a = 0; a < 3; a++) for (int b = 0; b < 3; b++) { J[a][b] = 0; for (int c = 0; c < 3; c++) J[a][b] += T[a][c] * R[b][c]; big = std::max(big, std::fabs(J[a][b])); }
            for (int a = 0; a < 3; a++) for (int b = 0; b < 3; b++) if (std::fabs(J[a][b]) < 1e-14 * big) J[a][b] = 0;
          }
          f[k + "/inertial/inertia"] = nums({J[0][0], J[0][1], J[0][2], J[1][1], J[1][2], J[2][2]});
        }
        f[k + "/visual"] = std::to_string(l.visual_array.size());
        for (size_t n = 0; n < l.visual_array.size(); n++) {
          auto &v = *l.visual_array[n];
          std::string e = k + "/visual/" + std::to_string(n);
          geometry(f, e + "/geometry", v.geometry);
          f[e + "/origin"] = pose(v.origin);
          if (!v.name.empty()) f[e + "/name"] = v.name;
          if (!v.material_name.empty()) f[e + "/material"] = v.material_name;
          if (v.material) {
            auto &c = v.material->color;
            f[e + "/color"] = nums({c.r, c.g, c.b, c.a});
            if (!v.material->texture_filename.empty()) f[e + "/texture"] = v.material->texture_filename;
          }
        }
        f[k + "/collision"] = std::to_string(l.collision_array.size());
        for (size_t n = 0; n < l.collision_array.size(); n++) {
          auto &v = *l.collision_array[n];
          std::string e = k + "/collision/" + std::to_string(n);
          geometry(f, e + "/geometry", v.geometry);
          f[e + "/origin"] = pose(v.origin);
          if (!v.name.empty()) f[e + "/name"] = v.name;
        }
      }
      static const char *types[] = {"unknown", "revolute", "continuous", "prismatic", "floating", "planar", "fixed"};
      for (auto &p : m->joints_) {
        std::string k = "joint/" + p.first;
        auto &j = *p.second;
        f[k] = types[j.type];
        f[k + "/parent"] = j.parent_link_name;
        f[k + "/child"] = j.child_link_name;
        f[k + "/origin"] = pose(j.parent_to_joint_origin_transform);
        if (j.type != urdf::Joint::FIXED && j.type != urdf::Joint::FLOATING) f[k + "/axis"] = nums({j.axis.x, j.axis.y, j.axis.z});
        if (j.limits) {
          f[k + "/lower"] = num(j.limits->lower);
          f[k + "/upper"] = num(j.limits->upper);
          f[k + "/effort"] = num(j.limits->effort);
          f[k + "/velocity"] = num(j.limits->velocity);
#ifndef OLD
          f[k + "/acceleration"] = num(j.limits->acceleration);
          f[k + "/deceleration"] = num(j.limits->deceleration);
          f[k + "/jerk"] = num(j.limits->jerk);
#endif
        }
        if (j.dynamics) { f[k + "/damping"] = num(j.dynamics->damping); f[k + "/friction"] = num(j.dynamics->friction); }
        if (j.mimic) f[k + "/mimic"] = j.mimic->joint_name + " " + nums({j.mimic->multiplier, j.mimic->offset});
        if (j.safety) f[k + "/safety"] = nums({j.safety->soft_lower_limit, j.safety->soft_upper_limit, j.safety->k_position, j.safety->k_velocity});
        if (j.calibration) f[k + "/calibration"] = (j.calibration->rising ? num(*j.calibration->rising) : "-") + " " + (j.calibration->falling ? num(*j.calibration->falling) : "-");
      }
    } else if (why.empty()) why = said.empty() ? "no model" : said[0];
    std::string o = std::string("{\"verdict\":") + (m ? "\"loads\"" : "\"refuses\"") + ",\"why\":" + quote(why) + ",\"said\":[";
    for (size_t n = 0; n < said.size() && n < 40; n++) o += (n ? "," : "") + quote(said[n]);
    o += "],\"facts\":{";
    bool first = true;
    for (auto &p : f) { o += (first ? "" : ",") + quote(p.first) + ":" + quote(p.second); first = false; }
    o += "}}\n";
    fputs(o.c_str(), out);
    fflush(out);
  }
}
