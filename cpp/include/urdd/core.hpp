// Errors, views of arrays, poses, and how handles are held.

#ifndef URDD_CORE_HPP
#define URDD_CORE_HPP

#if __cplusplus < 201703L
#error "urdd needs C++17: -std=c++17, or CMAKE_CXX_STANDARD 17"
#endif

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "../urdd.h"

namespace urdd {

/// A call that failed: its status, and the text that says what is wrong.
class Error : public std::runtime_error {
public:
    Error(urdd_status status, const std::string &message) : std::runtime_error(message), status_(status) {}

    /// The status of the C function.
    urdd_status status() const noexcept { return status_; }

private:
    urdd_status status_;
};

/// A view of an array of the caller's: pointer and length.
template <typename T> class Span {
public:
    constexpr Span() noexcept = default;
    constexpr Span(T *data, std::size_t size) noexcept : data_(data), size_(size) {}

    /// Of anything with `data()` and `size()`.
    template <typename C,
              typename = std::enable_if_t<std::is_convertible_v<decltype(std::declval<C &>().data()), T *> &&
                                          !std::is_same_v<std::decay_t<C>, Span>>>
    constexpr Span(C &&values) noexcept : data_(values.data()), size_(static_cast<std::size_t>(values.size())) {}

    constexpr T *data() const noexcept { return data_; }
    constexpr std::size_t size() const noexcept { return size_; }
    constexpr T *begin() const noexcept { return data_; }
    constexpr T *end() const noexcept { return data_ + size_; }
    constexpr T &operator[](std::size_t k) const noexcept { return data_[k]; }

private:
    T *data_ = nullptr;
    std::size_t size_ = 0;
};

/// Configurations, one after another: `rows` of `columns` values, rad or m.
struct Rows {
    const double *data;
    std::size_t rows;
    std::size_t columns;
};

/// A pose in the root link's frame, unless stated otherwise: a homogeneous 4 x 4 matrix in row-major order, metres.
using Pose = std::array<double, 16>;
/// A point, metres.
using Point = std::array<double, 3>;

/// The identity.
constexpr Pose identity() { return {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; }

/// The pose that moves by a translation, metres.
constexpr Pose translation(double x, double y, double z) { return {1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z, 0, 0, 0, 1}; }

namespace detail {

inline std::string string(urdd_text text) { return std::string(text.data, text.length); }

inline void check(urdd_status status) {
    if (status != URDD_STATUS_OK) throw Error(status, string(urdd_error_message()));
}

/// The library must be the header's.
inline void check_abi() {
    if (urdd_abi_version() != URDD_ABI_VERSION) {
        throw Error(URDD_STATUS_INTERNAL, "liburdd has ABI number " + std::to_string(urdd_abi_version()) +
                                              ", and urdd.h has " + std::to_string(URDD_ABI_VERSION) +
                                              ": install both from one release");
    }
}

template <typename T, urdd_status (*FREE)(T *)> struct Free {
    void operator()(T *handle) const noexcept { FREE(handle); }
};
template <typename T, urdd_status (*FREE)(T *)> using Handle = std::unique_ptr<T, Free<T, FREE>>;

/// A handle that `make` writes.
template <typename T, typename Make> T *made(Make &&make) {
    check_abi();
    T *handle = nullptr;
    check(make(&handle));
    return handle;
}

/// `bool` for each row; std::vector<bool> has no array.
inline std::vector<bool> answers(const std::unique_ptr<bool[]> &found, std::size_t rows) {
    return std::vector<bool>(found.get(), found.get() + rows);
}

/// Rows that belong together.
inline void same_shape(Rows a, Rows b) {
    if (a.rows != b.rows || a.columns != b.columns)
        throw Error(URDD_STATUS_LENGTH, "starts and ends must have as many rows and columns as each other");
}

} // namespace detail

/// Which shapes of the links are asked.
enum class ShapeKind { hulls, boxes, spheres, pieces, piece_boxes, piece_spheres };

/// The name of a kind, as in Rust, Python and on the command line.
inline const char *name(ShapeKind kind) {
    switch (kind) {
    case ShapeKind::hulls: return "hulls";
    case ShapeKind::boxes: return "boxes";
    case ShapeKind::spheres: return "spheres";
    case ShapeKind::pieces: return "pieces";
    case ShapeKind::piece_boxes: return "piece-boxes";
    case ShapeKind::piece_spheres: return "piece-spheres";
    }
    return "";
}

} // namespace urdd

#endif
