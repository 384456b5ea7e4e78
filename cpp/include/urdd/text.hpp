// The canonical JSON and YAML of a document (SPEC 3.3): what the reference generator writes, byte by byte.

#ifndef URDD_TEXT_HPP
#define URDD_TEXT_HPP

#include "json.hpp"

#include <algorithm>
#include <charconv>

namespace urdd::types {

namespace detail {

/// The shortest decimal that reads back as the same number, with a point (SPEC 3.3.3).
inline std::string number(double value) {
    if (value == 0) {
        return "0.0";
    }
    std::array<char, 32> room{};
    const auto end = std::to_chars(room.begin(), room.end(), value, std::chars_format::scientific).ptr;
    const std::string_view text(room.data(), static_cast<std::size_t>(end - room.data()));
    const std::size_t e = text.find('e');
    const std::string sign = text[0] == '-' ? "-" : "";
    std::string digits(text.substr(sign.size(), e - sign.size()));
    digits.erase(std::remove(digits.begin(), digits.end(), '.'), digits.end());
    const int exponent = std::stoi(std::string(text.substr(e + 1)));
    if (exponent < -4 || exponent >= 16) {
        const std::string rest = digits.size() > 1 ? digits.substr(1) : "0";
        return sign + digits[0] + "." + rest + "e" + (exponent < 0 ? "-" : "+") + std::to_string(std::abs(exponent));
    }
    if (exponent < 0) {
        return sign + "0." + std::string(static_cast<std::size_t>(-exponent - 1), '0') + digits;
    }
    const auto before = static_cast<std::size_t>(exponent) + 1;
    if (digits.size() <= before) {
        return sign + digits + std::string(before - digits.size(), '0') + ".0";
    }
    return sign + digits.substr(0, before) + "." + digits.substr(before);
}

inline std::string hexadecimal(unsigned code) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text = "\\u";
    for (const unsigned shift : {12U, 8U, 4U, 0U}) {
        text += digits[(code >> shift) & 15U];
    }
    return text;
}

/// A string in quotes (SPEC 3.3.4); for YAML, what its readers take for the end of a line is escaped too (3.3.5).
inline std::string quoted(const std::string &text, bool yaml) {
    constexpr std::string_view shorts = "\b\t\n\f\r";
    constexpr std::string_view letters = "btnfr";
    std::string out = "\"";
    for (std::size_t at = 0; at < text.size(); ++at) {
        const auto byte = static_cast<unsigned char>(text[at]);
        const std::size_t is_short = shorts.find(text[at]);
        // U+007F; U+0080 to U+009F are two bytes; U+2028, U+2029, U+FEFF, U+FFFE and U+FFFF three.
        const auto next = [&](std::size_t offset) {
            return at + offset < text.size() ? static_cast<unsigned char>(text[at + offset]) : 0U;
        };
        const unsigned two = byte == 0xC2 ? 0x80U | (next(1) & 0x3FU) : 0;
        const unsigned three = ((byte & 0xFU) << 12U) | ((next(1) & 0x3FU) << 6U) | (next(2) & 0x3FU);
        const bool is_three =
            byte >= 0xE0 && byte < 0xF0 && (three == 0x2028 || three == 0x2029 || three == 0xFEFF || three >= 0xFFFE);
        if (byte == '"' || byte == '\\') {
            out += '\\';
            out += text[at];
        } else if (is_short != std::string_view::npos) {
            out += '\\';
            out += letters[is_short];
        } else if (byte < 0x20 || (yaml && byte == 0x7F)) {
            out += hexadecimal(byte);
        } else if (yaml && two != 0 && two < 0xA0) {
            out += hexadecimal(two);
            at += 1;
        } else if (yaml && is_three) {
            out += hexadecimal(three);
            at += 2;
        } else {
            out += text[at];
        }
    }
    return out + "\"";
}

/// A string as YAML has it: plain where nothing can take it for something else.
inline std::string scalar(const std::string &text) {
    constexpr std::array<std::string_view, 9> words{"y", "n", "yes", "no", "on", "off", "true", "false", "null"};
    const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
    const auto is_more = [&](char c) {
        return is_letter(c) || (c >= '0' && c <= '9') || c == '.' || c == '/' || c == '-';
    };
    std::string lower = text;
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    const bool plain = !text.empty() && is_letter(text[0]) && std::all_of(text.begin(), text.end(), is_more) &&
                       std::find(words.begin(), words.end(), lower) == words.end();
    return plain ? text : quoted(text, true);
}

inline bool is_inline(const Json &json) {
    const auto is_scalar = [](const Json &item) { return !item.is_structured(); };
    return json.is_object() ? json.empty() : !json.is_array() || std::all_of(json.begin(), json.end(), is_scalar);
}

inline void inlined(const Json &json, bool yaml, std::string &out) {
    if (json.is_string()) {
        const auto &text = json.get_ref<const std::string &>();
        out += yaml ? scalar(text) : quoted(text, false);
    } else if (json.is_number_float()) {
        out += number(json.get<double>());
    } else if (json.is_array()) {
        out += '[';
        for (std::size_t index = 0; index < json.size(); ++index) {
            out += index == 0 ? "" : ", ";
            inlined(json[index], yaml, out);
        }
        out += ']';
    } else {
        out += json.is_object() ? "{}" : json.dump();
    }
}

inline void json_text(const Json &json, std::size_t indent, std::string &out) {
    if (is_inline(json)) {
        return inlined(json, false, out);
    }
    const std::string line = "\n" + std::string(indent + 2, ' ');
    bool first = true;
    out += json.is_object() ? '{' : '[';
    for (const auto &[key, value] : json.items()) {
        out += first ? "" : ",";
        first = false;
        out += line;
        if (json.is_object()) {
            out += quoted(key, false) + ": ";
        }
        json_text(value, indent + 2, out);
    }
    out += "\n" + std::string(indent, ' ') + (json.is_object() ? '}' : ']');
}

/// `begun`: the line of the first member is there, behind the dash of a list.
inline void yaml_text(const Json &json, std::size_t indent, bool begun, std::string &out) {
    const std::string spaces(indent, ' ');
    for (const auto &[key, value] : json.items()) {
        out += begun ? "" : spaces;
        begun = false;
        const std::string name = json.is_object() ? scalar(key) : "-";
        // More than 1,000 characters, not bytes.
        const auto starts = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; };
        const bool is_long = std::count_if(name.begin(), name.end(), starts) > 1000;
        out += !json.is_object() ? name : is_long ? "? " + name + "\n" + spaces + ":" : name + ":";
        if (is_inline(value)) {
            out += ' ';
            inlined(value, true, out);
            out += '\n';
        } else if (json.is_array() && value.is_object()) {
            out += ' ';
            yaml_text(value, indent + 2, true, out);
        } else {
            out += '\n';
            yaml_text(value, indent + 2, false, out);
        }
    }
}

} // namespace detail

/// The canonical JSON, for `module.json` and `urdd.json`.
template <class Document> std::string json_text(const Document &document) {
    std::string out;
    detail::json_text(to_json(document), 0, out);
    return out + "\n";
}

/// The canonical YAML, for `module.yaml`.
template <class Document> std::string yaml_text(const Document &document) {
    const Json json = to_json(document);
    std::string out;
    if (detail::is_inline(json)) {
        detail::inlined(json, true, out);
        return out + "\n";
    }
    detail::yaml_text(json, 0, false, out);
    return out;
}

} // namespace urdd::types

#endif
