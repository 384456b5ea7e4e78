// An XML file as a tree of elements, by expat, which says where each begins and ends: what a URDD does not know it
// keeps as it stands in the file (SPEC 6.1.1).

#ifndef PRODUCER_XML_HPP
#define PRODUCER_XML_HPP

#include <expat.h>
#include <map>
#include <memory>
#include <optional>
#include <regex>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

/// Why a URDF has no URDD.
struct Refused : std::runtime_error {
    using std::runtime_error::runtime_error;
};

inline void demand(bool condition, const std::string &why) {
    if (!condition) {
        throw Refused(why);
    }
}

struct Element {
    std::string tag;
    std::map<std::string, std::string> attributes;
    std::vector<std::unique_ptr<Element>> children;
    std::string xml;

    [[nodiscard]] std::optional<std::string> get(const std::string &key) const {
        const auto found = attributes.find(key);
        return found == attributes.end() ? std::nullopt : std::optional(found->second);
    }
    std::string required(const std::string &key) const {
        const auto value = get(key);
        demand(value.has_value(), "<" + tag + "> without " + key);
        return *value;
    }
    [[nodiscard]] std::vector<const Element *> all(const std::string &name) const {
        std::vector<const Element *> found;
        for (const auto &child : children) {
            if (child->tag == name) {
                found.push_back(child.get());
            }
        }
        return found;
    }
    [[nodiscard]] const Element *first(const std::string &name) const {
        const auto found = all(name);
        return found.empty() ? nullptr : found[0];
    }
    [[nodiscard]] std::vector<std::string> others(const std::set<std::string> &known) const {
        std::vector<std::string> found;
        for (const auto &child : children) {
            if (known.count(child->tag) == 0) {
                found.push_back(child->xml);
            }
        }
        return found;
    }
};

namespace xml {

constexpr std::size_t max_bytes = 64U << 20U, max_levels = 256, max_elements = 500000; // SPEC 6.1.8
constexpr std::size_t max_attributes = 256, max_prefixes = 64;

struct Reader {
    const std::string &text;
    XML_Parser parser;
    Element top;
    std::vector<std::pair<Element *, std::size_t>> open;
    std::set<std::string> prefixes;
    std::size_t elements = 0;
    std::string refused;

    // Exceptions must not pass through expat.
    void refuse(const std::string &why) {
        refused = why;
        XML_StopParser(parser, XML_FALSE);
    }

    void start(const char *tag, const char **attributes) {
        auto element = std::make_unique<Element>();
        element->tag = tag;
        for (; *attributes != nullptr; attributes += 2) {
            element->attributes[attributes[0]] = attributes[1];
            if (std::string(attributes[0]).rfind("xmlns:", 0) == 0) {
                prefixes.insert(attributes[0]);
            }
        }
        ++elements;
        if (open.size() >= max_levels || elements > max_elements || element->attributes.size() > max_attributes ||
            prefixes.size() > max_prefixes) {
            return refuse("too many levels, elements, attributes or prefixes");
        }
        Element &above = open.empty() ? top : *open.back().first;
        open.emplace_back(element.get(), static_cast<std::size_t>(XML_GetCurrentByteIndex(parser)));
        above.children.push_back(std::move(element));
    }

    void end() {
        const auto [element, begin] = open.back();
        open.pop_back();
        // The start tag ends at the first > outside of quotes.
        std::size_t at = begin;
        for (char quote = 0; quote != 0 || text[at] != '>'; ++at) {
            if (quote != 0 ? text[at] == quote : text[at] == '"' || text[at] == '\'') {
                quote = quote == 0 ? text[at] : '\0';
            }
        }
        if (text[at - 1] != '/') {
            at = text.find('>', static_cast<std::size_t>(XML_GetCurrentByteIndex(parser)));
        }
        element->xml = text.substr(begin, at + 1 - begin);
    }
};

inline void run(XML_Parser parser, const std::string &text) {
    if (XML_Parse(parser, text.data(), static_cast<int>(text.size()), XML_TRUE) != XML_STATUS_OK) {
        throw Refused(std::string(XML_ErrorString(XML_GetErrorCode(parser))) + " in line " +
                      std::to_string(XML_GetCurrentLineNumber(parser)));
    }
}

/// The root element.
inline std::unique_ptr<Element> parse(std::string text) {
    demand(text.size() <= max_bytes, "more than " + std::to_string(max_bytes) + " bytes");
    if (text.rfind("\xEF\xBB\xBF", 0) == 0) {
        text.erase(0, 3);
    }
    std::smatch declared;
    const std::string head = text.substr(0, 200);
    const std::regex declaration(
        "^<\\?xml\\s+version\\s*=\\s*[\"']([^\"']*)[\"'](?:\\s+encoding\\s*=\\s*[\"']([^\"']*))?");
    if (std::regex_search(head, declared, declaration)) {
        demand(std::regex_match(declared.str(1), std::regex("1\\.[0-9]+")), "XML of version " + declared.str(1));
        demand(!declared[2].matched || std::regex_match(declared.str(2), std::regex("utf-?8", std::regex::icase)),
               "the encoding " + declared.str(2));
    }
    using Parser = std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)>;
    const Parser parser(XML_ParserCreate("UTF-8"), XML_ParserFree);
    Reader reader{text, parser.get(), {}, {}, {}, 0, {}};
    XML_SetUserData(parser.get(), &reader);
    XML_SetElementHandler(
        parser.get(),
        [](void *data, const char *tag, const char **attributes) {
            static_cast<Reader *>(data)->start(tag, attributes);
        },
        [](void *data, const char *) { static_cast<Reader *>(data)->end(); });
    XML_SetStartDoctypeDeclHandler(parser.get(), [](void *data, const char *, const char *, const char *, int) {
        static_cast<Reader *>(data)->refuse("a DOCTYPE");
    });
    try {
        run(parser.get(), text);
    } catch (const Refused &) {
        demand(reader.refused.empty(), reader.refused);
        throw;
    }
    // Once more, for namespaces.
    run(Parser(XML_ParserCreateNS("UTF-8", ' '), XML_ParserFree).get(), text);
    return std::move(reader.top.children.at(0));
}

} // namespace xml

#endif
