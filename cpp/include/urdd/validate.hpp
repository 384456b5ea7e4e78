// Validation.

#ifndef URDD_VALIDATE_HPP
#define URDD_VALIDATE_HPP

#include "core.hpp"

namespace urdd {

/// What validation found: whether every URDD passes, and the report as JSON.
struct Report {
    bool passes;
    std::string json;
};

/// Validates every URDD at or below a path. `settings` is the text of a urdd.toml.
inline Report validate(const std::string &path, const std::string &settings = "") {
    detail::Handle<urdd_report, urdd_report_free> report(detail::made<urdd_report>(
        [&](urdd_report **out) { return urdd_validate(detail::c_text(path), detail::c_text(settings), out); }));
    Report found{};
    urdd_text text{};
    detail::check(urdd_report_passes(report.get(), &found.passes));
    detail::check(urdd_report_json(report.get(), &text));
    found.json = detail::string(text);
    return found;
}

} // namespace urdd

#endif
