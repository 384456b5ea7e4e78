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

namespace detail {

/// Whether the values of a container are one after another. Of an Eigen expression, its strides say so; of other types,
/// `data()` and `size()`.
template <typename C, typename = void> struct IsTight : std::true_type {};
template <typename C>
struct IsTight<C, std::void_t<typename C::PlainObject>>
    : std::bool_constant<std::is_same_v<C, typename C::PlainObject> ||
                         (int(C::InnerStrideAtCompileTime) == 1 &&
                          (bool(C::IsVectorAtCompileTime) ||
                           (int(C::InnerSizeAtCompileTime) > 0 &&
                            int(C::OuterStrideAtCompileTime) == int(C::InnerSizeAtCompileTime))))> {};

/// Whether values go when the object goes: not so of views, such as Span, std::span, Eigen::Map.
template <typename C, typename T, typename = void>
struct IsOwner
    : std::bool_constant<!std::is_convertible_v<decltype(std::declval<const C &>().data()), std::remove_const_t<T> *>> {
};
template <typename C, typename T>
struct IsOwner<C, T, std::void_t<typename C::PlainObject>> : std::is_same<C, typename C::PlainObject> {};

template <typename C, typename T>
using HasValues = std::enable_if_t<std::is_convertible_v<decltype(std::declval<C &>().data()), T *>>;

} // namespace detail

/// A view of an array: pointer and length. Temporaries that own their values are refused.
template <typename T> class Span {
public:
    constexpr Span() noexcept = default;
    constexpr Span(T *data, std::size_t size) noexcept : data_(data), size_(size) {}

    /// Of anything with `data()` and `size()`.
    template <typename C, typename = detail::HasValues<C, T>,
              typename = std::enable_if_t<!std::is_base_of_v<Span, std::decay_t<C>>>>
    constexpr Span(C &&values) noexcept : Span(values.data(), static_cast<std::size_t>(values.size())) {
        static_assert(detail::IsTight<std::decay_t<C>>::value,
                      "the values are not one after another, as in a row of a column-major matrix: copy them first");
        static_assert(std::is_lvalue_reference_v<C> || !detail::IsOwner<std::decay_t<C>, T>::value,
                      "the values go at the end of this statement: keep them in a variable first");
    }

    constexpr T *data() const noexcept { return data_; }
    constexpr std::size_t size() const noexcept { return size_; }
    constexpr T *begin() const noexcept { return data_; }
    constexpr T *end() const noexcept { return data_ + size_; }
    constexpr T &operator[](std::size_t k) const noexcept { return data_[k]; }

private:
    T *data_ = nullptr;
    std::size_t size_ = 0;
};

/// A `Span` as an argument: inputs can be temporaries, which live as long as the call. Not for variables.
template <typename T> class Argument : public Span<T> {
public:
    constexpr Argument() noexcept = default;
    constexpr Argument(T *data, std::size_t size) noexcept : Span<T>(data, size) {}
    constexpr Argument(Span<T> values) noexcept : Span<T>(values) {}
    template <typename C, typename = detail::HasValues<C, T>,
              typename = std::enable_if_t<!std::is_base_of_v<Span<T>, std::decay_t<C>>>>
    constexpr Argument(C &&values) noexcept : Span<T>(values.data(), static_cast<std::size_t>(values.size())) {
        static_assert(detail::IsTight<std::decay_t<C>>::value,
                      "the values are not one after another, as in a row of a column-major matrix: copy them first");
        static_assert(std::is_const_v<T> || std::is_lvalue_reference_v<C> ||
                          !detail::IsOwner<std::decay_t<C>, T>::value,
                      "results would be written to a temporary: keep it in a variable first");
    }
};

/// Configurations, one after another: `rows` of `columns` values, rad or m.
struct Rows {
    constexpr Rows(const double *values, std::size_t count, std::size_t dofs) noexcept
        : data(values), rows(count), columns(dofs) {}
    /// As many rows as there are values for.
    Rows(Span<const double> values, std::size_t dofs)
        : Rows(values.data(), dofs == 0 ? 1 : values.size() / dofs, dofs) {
        if (rows * columns != values.size())
            throw Error(URDD_STATUS_LENGTH,
                        std::to_string(values.size()) + " values: expected a multiple of " + std::to_string(dofs));
    }

    const double *data;
    std::size_t rows;
    std::size_t columns;
};

/// A pose in the root link's frame, unless stated otherwise: a homogeneous 4 x 4 matrix in row-major order, metres.
using Pose = std::array<double, 16>;
/// A point, metres.
using Point = std::array<double, 3>;

/// Poses, by link. Of a temporary, `[]` gives a copy, so that nothing refers to what is gone.
class Poses : public std::vector<Pose> {
public:
    using std::vector<Pose>::vector;
    const Pose &operator[](std::size_t k) const & { return std::vector<Pose>::operator[](k); }
    Pose &operator[](std::size_t k) & { return std::vector<Pose>::operator[](k); }
    Pose operator[](std::size_t k) && { return std::vector<Pose>::operator[](k); }
};

/// The identity.
constexpr Pose identity() { return {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; }

/// The pose that moves by a translation, metres.
constexpr Pose translation(double x, double y, double z) { return {1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z, 0, 0, 0, 1}; }

/// `a`, then `b` in the frame of `a`: the product of the matrices.
constexpr Pose compose(const Pose &a, const Pose &b) {
    Pose found{};
    for (std::size_t k = 0; k < 16; ++k) {
        for (std::size_t j = 0; j < 4; ++j)
            found[k] += a[k / 4 * 4 + j] * b[j * 4 + k % 4];
    }
    return found;
}

/// The inverse of a rotation and a translation.
constexpr Pose inverse(const Pose &a) {
    return {a[0], a[4], a[8],  -(a[0] * a[3] + a[4] * a[7] + a[8] * a[11]),
            a[1], a[5], a[9],  -(a[1] * a[3] + a[5] * a[7] + a[9] * a[11]),
            a[2], a[6], a[10], -(a[2] * a[3] + a[6] * a[7] + a[10] * a[11]),
            0,    0,    0,     1};
}

/// A point of the frame `a`, in the frame that `a` is a pose in.
constexpr Point transform(const Pose &a, const Point &p) {
    return {a[0] * p[0] + a[1] * p[1] + a[2] * p[2] + a[3], a[4] * p[0] + a[5] * p[1] + a[6] * p[2] + a[7],
            a[8] * p[0] + a[9] * p[1] + a[10] * p[2] + a[11]};
}

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

/// A text for C, which ends at the first zero byte: one inside is refused.
inline const char *c_text(const std::string &text) {
    const std::size_t zero = text.find('\0');
    if (zero != std::string::npos)
        throw Error(URDD_STATUS_VALUE, "a text has a zero byte at place " + std::to_string(zero) + ": \"" +
                                           text.substr(0, zero) + "\" comes before it");
    return text.c_str();
}

/// What holds a handle: copies share it, and the last one frees it.
template <typename T, urdd_status (*FREE)(T *)> class Handle {
public:
    using pointer = T *;
    explicit Handle(T *handle) : handle_(handle, [](T *last) { FREE(last); }) {}
    T *get() const noexcept { return handle_.get(); }

private:
    std::shared_ptr<T> handle_;
};

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

/// Room for as many results as are written.
inline void same_size(const char *what, std::size_t found, std::size_t expected) {
    if (found != expected)
        throw Error(URDD_STATUS_LENGTH, std::string(what) + ": room for " + std::to_string(found) +
                                            " values, expected " + std::to_string(expected));
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
