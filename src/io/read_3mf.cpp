#include "io/messages.hpp"
#include "io/readers.hpp"
#include "io/scene_builder.hpp"
#include "io/xml_part.hpp"
#include "io/zip_archive.hpp"

#include <fast_float/fast_float.h>
#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <set>
#include <utility>

namespace delmesh::io {

namespace {

constexpr std::string_view core = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
constexpr std::string_view production = "http://schemas.microsoft.com/3dmanufacturing/production/2015/06";
constexpr std::string_view relationship_to_model = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";
constexpr std::string_view blanks = " \t\r\n";

/// An object stands in a part (a model file) of the package, under a number.
using ObjectId = std::pair<std::string, std::uint32_t>;

struct Use {
    ObjectId object;
    Transform transform;
};

/// A mesh, or other objects.
struct Object {
    std::vector<Vec3> points;
    std::vector<std::uint32_t> corners;
    std::vector<Use> components;
};

struct Package {
    std::map<ObjectId, Object> objects;
    std::vector<Use> items;
    std::vector<std::string> parts;  ///< what is to be read, in the order of naming
};

std::string found_text(std::string_view text) {
    return text.empty() ? std::string("none") : quote(text);
}

/// Takes a number from the front of the text.
double take_number(std::string_view& text, const char* expected, const XmlPart& xml) {
    const std::size_t first = std::min(text.find_first_not_of(blanks), text.size());
    const char* const begin = text.data() + first + (text.substr(first).starts_with('+') ? 1 : 0);
    const char* const end = text.data() + text.size();
    double value = 0;
    const auto [after, error] = fast_float::from_chars(begin, end, value);
    if (error != std::errc() || (after != end && blanks.find(*after) == blanks.npos))
        xml.fail(fmt::format("expected {}, found {}", expected, found_text(text.substr(first))));
    text.remove_prefix(static_cast<std::size_t>(after - text.data()));
    return value;
}

double number(std::string_view text, const char* expected, const XmlPart& xml) {
    const std::string_view whole = text;
    const double value = take_number(text, expected, xml);
    if (text.find_first_not_of(blanks) != text.npos)
        xml.fail(fmt::format("expected {}, found {}", expected, found_text(whole)));
    return value;
}

std::uint32_t integer(std::string_view text, const char* expected, const XmlPart& xml) {
    std::uint32_t value = 0;
    const char* const end = text.data() + text.size();
    const auto [after, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || after != end)
        xml.fail(fmt::format("expected {}, found {}", expected, found_text(text)));
    return value;
}

/// Twelve numbers: the images of the axes, then of the origin.
Transform transform_of(std::string_view text, const XmlPart& xml) {
    Transform result;
    if (text.empty()) return result;
    for (Vec3& column : result.columns)
        for (const int axis : {0, 1, 2}) column[axis] = take_number(text, "twelve numbers of a transform", xml);
    if (text.find_first_not_of(blanks) != text.npos) xml.fail("expected twelve numbers of a transform, found more");
    return result;
}

std::string without_slash(std::string_view path) {
    return std::string(path.starts_with('/') ? path.substr(1) : path);
}

/// Reads one model file into a package.
class ModelPart {
public:
    ModelPart(ZipArchive& archive, const std::string& part, bool is_root, Package& package)
        : xml_(archive, part),
          is_root_(is_root),
          package_(package) {
        xml_.start = [this](std::string_view name, const XmlAttributes& attributes) { start(name, attributes); };
        xml_.end = [this](std::string_view name) {
            if (local(name) == "object") object_ = nullptr;
        };
    }
    void read() { xml_.parse(); }

private:
    /// The name in the core name space; empty for names of others, which are passed over.
    static std::string_view local(std::string_view name) {
        const std::size_t bar = name.find(XmlPart::between);
        return bar != name.npos && name.substr(0, bar) == core ? name.substr(bar + 1) : std::string_view();
    }

    void start(std::string_view name, const XmlAttributes& attributes) {
        const std::string_view element = local(name);
        if (element == "vertex") {
            add_vertex(attributes);
        } else if (element == "triangle") {
            add_triangle(attributes);
        } else if (element == "object") {
            begin_object(attributes);
        } else if (element == "component") {
            open_object("a component").components.push_back(use_of(attributes));
        } else if (element == "item" && is_root_) {
            package_.items.push_back(use_of(attributes));
        } else if (element == "model") {
            refuse_extensions(attributes.get("requiredextensions"));
        }
    }

    void refuse_extensions(std::string_view prefixes) const {
        constexpr std::array harmless{
            production, std::string_view("http://schemas.microsoft.com/3dmanufacturing/material/2015/02"),
            std::string_view("http://schemas.microsoft.com/3dmanufacturing/trianglesets/2021/07")};
        while (!prefixes.empty()) {
            const std::size_t end = std::min(prefixes.find_first_of(blanks), prefixes.size());
            const std::string prefix(prefixes.substr(0, end));
            prefixes.remove_prefix(std::min(end + 1, prefixes.size()));
            if (prefix.empty() || std::ranges::find(harmless, xml_.name_space(prefix)) != harmless.end()) continue;
            xml_.fail(fmt::format("expected plain 3MF, found that the extension {} is needed, which is not read: save "
                                  "the mesh without it",
                                  quote(prefix)),
                      ErrorCode::unsupported_format);
        }
    }

    void begin_object(const XmlAttributes& attributes) {
        const ObjectId id{xml_.part(), integer(attributes.get("id"), "the number of an object", xml_)};
        const auto [place, is_new] = package_.objects.try_emplace(id);
        if (!is_new) xml_.fail(fmt::format("expected a new number of an object, found {} again", id.second));
        object_ = &place->second;
    }

    Object& open_object(const char* what) {
        if (object_ == nullptr) xml_.fail(fmt::format("expected {} in an object, found it outside", what));
        return *object_;
    }

    void add_vertex(const XmlAttributes& attributes) {
        open_object("a vertex")
            .points.push_back({number(attributes.get("x"), "a coordinate x", xml_),
                               number(attributes.get("y"), "a coordinate y", xml_),
                               number(attributes.get("z"), "a coordinate z", xml_)});
    }

    void add_triangle(const XmlAttributes& attributes) {
        Object& object = open_object("a triangle");
        for (const char* corner : {"v1", "v2", "v3"}) {
            const std::uint32_t vertex = integer(attributes.get(corner), "a vertex index", xml_);
            if (vertex >= object.points.size())
                xml_.fail(fmt::format("expected a vertex index below {}, found {}", object.points.size(), vertex),
                          ErrorCode::index_out_of_range);
            object.corners.push_back(vertex);
        }
    }

    Use use_of(const XmlAttributes& attributes) {
        const std::string_view path = attributes.get(std::string(production) + XmlPart::between + "path");
        const std::string part = path.empty() ? xml_.part() : without_slash(path);
        if (!path.empty() && part != package_.parts.back()) package_.parts.push_back(part);
        return {{part, integer(attributes.get("objectid"), "the number of an object", xml_)},
                transform_of(attributes.get("transform"), xml_)};
    }

    XmlPart xml_;
    bool is_root_;
    Package& package_;
    Object* object_ = nullptr;
};

std::string find_root(ZipArchive& archive) {
    std::string root;
    XmlPart relationships(archive, "_rels/.rels");
    relationships.start = [&root](std::string_view, const XmlAttributes& attributes) {
        if (attributes.get("Type") == relationship_to_model && root.empty())
            root = without_slash(attributes.get("Target"));
    };
    relationships.parse();
    if (root.empty())
        throw Error(
            ErrorCode::unsupported_format,
            archive.name() + ": expected a 3MF package, found a ZIP archive that names no 3D model: unpack it first");
    return root;
}

Package read_package(ZipArchive& archive) {
    Package package;
    package.parts.push_back(find_root(archive));
    std::set<std::string> done;
    for (std::size_t i = 0; i < package.parts.size(); ++i) {
        const std::string part = package.parts[i];
        if (done.insert(part).second) ModelPart(archive, part, i == 0, package).read();
    }
    return package;
}

/// Puts the objects that are built where they are built.
class Flattener {
public:
    Flattener(const Package& package, const ZipArchive& archive)
        : package_(package),
          archive_(archive),
          scene_(archive.name(), archive.size()) {}

    PolygonSoup flatten() {
        for (const Use& item : package_.items) place(item, Transform(), 0);
        return std::move(scene_.soup());
    }

private:
    void place(const Use& use, const Transform& above, int depth) {
        constexpr int deepest = 32;
        if (depth > deepest) fail(fmt::format("expected 3MF components at most {} deep, found more", deepest));
        const auto found = package_.objects.find(use.object);
        if (found == package_.objects.end())
            fail(fmt::format("expected an object that is in the package, found number {} of {}", use.object.second,
                             quote(use.object.first)));
        const Object& object = found->second;
        scene_.expect(1 + object.points.size() + object.corners.size());
        const Transform transform = above * use.transform;
        scene_.add_mesh(object.points, object.corners, transform);
        for (const Use& component : object.components) place(component, transform, depth + 1);
    }

    [[noreturn]] void fail(const std::string& what) const {
        throw Error(ErrorCode::file_format, archive_.name() + ": " + with_advice(what, ErrorCode::file_format));
    }

    const Package& package_;
    const ZipArchive& archive_;
    SceneBuilder scene_;
};

}  // namespace

PolygonSoup read_3mf(Input& input) {
    ZipArchive archive(input);
    const Package package = read_package(archive);
    return Flattener(package, archive).flatten();
}

}  // namespace delmesh::io
