// Documents of a URDD from JSON and to JSON, for the types in urdd_types.hpp.

#ifndef URDD_JSON_HPP
#define URDD_JSON_HPP

#if __cplusplus < 201703L
#error "urdd needs C++17: -std=c++17, or CMAKE_CXX_STANDARD 17"
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace urdd::types {

/// A document without a type. Its members keep their order.
using Json = nlohmann::ordered_json;

/// Why a document cannot be read or written: what is wrong, and where.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

namespace detail {

/// The words of an enumeration, in its order. Specialised for each.
template <class Enum> struct Words;

/// Where a reader is: a member or an element of what is above.
struct Place {
    const Place *above = nullptr;
    std::string_view key;
    std::size_t index = 0;
    std::size_t depth = 0;

    [[nodiscard]] std::string text() const {
        if (above == nullptr) {
            return "";
        }
        return above->text() + "/" + (key.empty() ? std::to_string(index) : std::string(key));
    }
};

/// More than any document needs: only compositions nest.
constexpr std::size_t max_depth = 256;

[[noreturn]] inline void fail(const Place &place, const std::string &what) {
    const std::string at = place.text();
    throw Error((at.empty() ? "the document" : "at " + at) + ": " + what);
}

[[noreturn]] inline void wrong(const Place &place, const Json &json, const char *wanted) {
    fail(place, std::string(wanted) + " is wanted here, and this is " + json.type_name());
}

// One struct for each kind of value: overloads would have to be declared before the types that they are found for.
template <class Value, class = void> struct Form;

template <class Value> void read(const Json &json, Value &value, const Place &place) {
    Form<Value>::read(json, value, place);
}

template <class Value> Json write(const Value &value) { return Form<Value>::write(value); }

template <> struct Form<bool> {
    static void read(const Json &json, bool &value, const Place &place) {
        if (!json.is_boolean()) {
            wrong(place, json, "true or false");
        }
        value = json.get<bool>();
    }
    static Json write(bool value) { return value; }
};

template <> struct Form<double> {
    static void read(const Json &json, double &value, const Place &place) {
        if (!json.is_number()) {
            wrong(place, json, "a number");
        }
        value = json.get<double>();
    }
    static Json write(double value) {
        if (!std::isfinite(value)) {
            throw Error("a number that is not finite cannot be written as JSON");
        }
        return value + 0.0; // without negative zero
    }
};

template <> struct Form<std::size_t> {
    static void read(const Json &json, std::size_t &value, const Place &place) {
        constexpr double limit = 18446744073709551616.0;
        if (json.is_number_unsigned()) {
            value = json.get<std::size_t>();
            return;
        }
        // An integer may be written as 1.0.
        const double number = json.is_number_float() ? json.get<double>() : -1;
        if (!(number >= 0 && number < limit) || std::trunc(number) != number) {
            wrong(place, json, "an integer from 0 on");
        }
        value = static_cast<std::size_t>(number);
    }
    static Json write(std::size_t value) { return value; }
};

template <> struct Form<std::string> {
    static void read(const Json &json, std::string &value, const Place &place) {
        if (!json.is_string()) {
            wrong(place, json, "a string");
        }
        value = json.get<std::string>();
    }
    static Json write(const std::string &value) { return value; }
};

template <class Enum> struct Form<Enum, std::enable_if_t<std::is_enum_v<Enum>>> {
    static void read(const Json &json, Enum &value, const Place &place) {
        std::string text;
        Form<std::string>::read(json, text, place);
        const auto &words = Words<Enum>::words;
        for (std::size_t index = 0; index < words.size(); ++index) {
            if (words[index] == text) {
                value = static_cast<Enum>(index);
                return;
            }
        }
        fail(place, "unknown word \"" + text.substr(0, 80) + "\"");
    }
    static Json write(Enum value) {
        const auto index = static_cast<std::size_t>(value);
        return std::string(Words<Enum>::words.at(index));
    }
};

template <class Item> struct Form<std::optional<Item>> {
    static void read(const Json &json, std::optional<Item> &value, const Place &place) {
        value.reset();
        if (!json.is_null()) {
            detail::read(json, value.emplace(), place);
        }
    }
    static Json write(const std::optional<Item> &value) { return value ? detail::write(*value) : Json(nullptr); }
};

template <class List> void read_items(const Json &json, List &list, const Place &place) {
    for (std::size_t index = 0; index < json.size(); ++index) {
        typename List::value_type item{};
        detail::read(json[index], item, Place{&place, {}, index, place.depth + 1});
        list[index] = std::move(item);
    }
}

template <class List> Json write_items(const List &list) {
    Json json = Json::array();
    for (const typename List::value_type &item : list) {
        json.push_back(detail::write(item));
    }
    return json;
}

template <class Item> struct Form<std::vector<Item>> {
    static void read(const Json &json, std::vector<Item> &value, const Place &place) {
        if (!json.is_array()) {
            wrong(place, json, "a list");
        }
        value.clear();
        value.resize(json.size());
        read_items(json, value, place);
    }
    static Json write(const std::vector<Item> &value) { return write_items(value); }
};

template <class Item, std::size_t size> struct Form<std::array<Item, size>> {
    static void read(const Json &json, std::array<Item, size> &value, const Place &place) {
        if (!json.is_array() || json.size() != size) {
            fail(place, "a list of " + std::to_string(size) + " is wanted here");
        }
        read_items(json, value, place);
    }
    static Json write(const std::array<Item, size> &value) { return write_items(value); }
};

/// Reads the members of an object. Each is taken once; what is left is `extra`.
struct Reader {
    const Json &json;
    const Place &place;
    std::vector<std::string_view> known;

    template <class Value> void required(const char *key, Value &value) {
        if (!member(key, value)) {
            fail(place, std::string("the key \"") + key + "\" is missing");
        }
    }

    template <class Value> void optional(const char *key, std::optional<Value> &value) {
        value.reset();
        member(key, value);
    }

    void extra(Json &value) {
        value = nullptr;
        for (const auto &[key, member] : json.items()) {
            if (std::find(known.begin(), known.end(), key) == known.end()) {
                value[key] = member;
            }
        }
    }

private:
    template <class Value> bool member(const char *key, Value &value) {
        const auto found = json.find(key);
        if (found == json.end()) {
            return false;
        }
        known.push_back(key);
        read(*found, value, Place{&place, key, 0, place.depth + 1});
        return true;
    }
};

struct Writer {
    Json &json;

    template <class Value> void required(const char *key, const Value &value) { json[key] = detail::write(value); }

    template <class Value> void optional(const char *key, const std::optional<Value> &value) {
        if (value) {
            json[key] = detail::write(*value);
        }
    }

    void extra(const Json &value) {
        if (value.is_null()) {
            return;
        }
        for (const auto &[key, member] : value.items()) {
            if (json.contains(key)) {
                throw Error("`extra` has the key \"" + key + "\" of the object itself");
            }
            json[key] = member;
        }
    }
};

/// Whether an object has all keys that one of this type must have.
struct Match {
    const Json &json;
    bool fits = true;

    template <class Value> void required(const char *key, const Value &) { fits = fits && json.contains(key); }
    template <class Value> void optional(const char *, const Value &) {}
    void extra(const Json &) {}
};

template <class... Kinds> struct Form<std::variant<Kinds...>> {
    static void read(const Json &json, std::variant<Kinds...> &value, const Place &place) {
        if (!json.is_object()) {
            wrong(place, json, "an object");
        }
        if (!(read_as<Kinds>(json, value, place) || ...)) {
            fail(place, "an object of a kind that this version does not know");
        }
    }
    static Json write(const std::variant<Kinds...> &value) {
        return std::visit([](const auto &kind) { return detail::write(kind); }, value);
    }

private:
    template <class Kind> static bool read_as(const Json &json, std::variant<Kinds...> &value, const Place &place) {
        Kind kind{};
        Match match{json};
        Kind::members(kind, match);
        if (match.fits) {
            detail::read(json, kind, place);
            value = std::move(kind);
        }
        return match.fits;
    }
};

// An object: a type with `members`.
template <class Object> struct Form<Object, std::void_t<decltype(Object::extra)>> {
    static void read(const Json &json, Object &value, const Place &place) {
        if (!json.is_object()) {
            wrong(place, json, "an object");
        }
        if (place.depth > max_depth) {
            fail(place, "too many levels");
        }
        Reader reader{json, place, {}};
        Object::members(value, reader);
    }
    static Json write(const Object &value) {
        Json json = Json::object();
        Writer writer{json};
        Object::members(value, writer);
        return json;
    }
};

inline std::string bytes_of(const std::string &path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    const bool is_empty = file.peek() == std::ifstream::traits_type::eof();
    if (!is_empty) {
        text << file.rdbuf();
    }
    // A folder opens, and cannot be read.
    if (!file.is_open() || file.bad() || text.fail()) {
        throw Error(path + ": cannot be read");
    }
    return text.str();
}

} // namespace detail

/// The word of a value of an enumeration, as it stands in files.
template <class Enum> std::string_view word(Enum value) {
    return detail::Words<Enum>::words.at(static_cast<std::size_t>(value));
}

/// A document from its JSON. Keys that its type does not have are in `extra`, and written again.
template <class Document> Document parse(std::string_view text) {
    Document document{};
    try {
        detail::read(Json::parse(text), document, detail::Place{});
    } catch (const Json::exception &error) {
        throw Error(std::string("the document is not JSON: ") + error.what());
    }
    return document;
}

/// A document as JSON without a type. SPEC 3.3's text of it: <urdd/text.hpp>.
template <class Document> Json to_json(const Document &document) { return detail::write(document); }

/// A document from a file.
template <class Document> Document read_file(const std::string &path) {
    const std::string text = detail::bytes_of(path);
    try {
        return parse<Document>(text);
    } catch (const Error &error) {
        throw Error(path + ": " + error.what());
    }
}

/// A module of the URDD in a folder: `read_module<ChainModule>("arm")`. Later minor versions are read too; one of
/// another major version is an error.
template <class Module> Module read_module(const std::string &urdd) {
    const std::string folder = urdd + "/" + Module::module_folder + "/";
    std::string version = detail::bytes_of(folder + "VERSION");
    version.erase(version.find_last_not_of(" \r\n") + 1);
    if (version.rfind("1.", 0) != 0) {
        throw Error(folder + "VERSION: is version " + version.substr(0, 20) + ", and these types are of version 1");
    }
    return read_file<Module>(folder + "module.json");
}

} // namespace urdd::types

#endif
