#include "tests/texture_db/tiny_onnx.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace weft {
namespace {

// Protocol buffers: a field is its number and wire type, then a variable-length number (0) or a
// length and that many bytes (2).
void put_number(std::string& out, std::uint64_t v) {
    for (; v > 127; v >>= 7)
        out += static_cast<char>(0x80 | (v & 127));
    out += static_cast<char>(v);
}
void put(std::string& out, int field, std::uint64_t v) {
    put_number(out, static_cast<std::uint64_t>(field) << 3);
    put_number(out, v);
}
void put(std::string& out, int field, std::string_view bytes) {
    put_number(out, (static_cast<std::uint64_t>(field) << 3) | 2);
    put_number(out, bytes.size());
    out += bytes;
}

// ValueInfoProto: name 1, type 2 { tensor 1 { element 1 = float, shape 2 { dim 1 { value 1 } } } }
std::string value(std::string_view name, const std::vector<int>& shape) {
    std::string dims, tensor, type, out;
    for (const int size : shape) {
        std::string dim;
        put(dim, 1, static_cast<std::uint64_t>(size));
        put(dims, 1, dim);
    }
    put(tensor, 1, 1);
    put(tensor, 2, dims);
    put(type, 1, tensor);
    put(out, 1, name);
    put(out, 2, type);
    return out;
}

// NodeProto: input 1, output 2, name 3, operator 4
std::string node(std::string_view operation, std::string_view from, std::string_view to) {
    std::string out;
    put(out, 1, from);
    put(out, 2, to);
    put(out, 3, operation);
    put(out, 4, operation);
    return out;
}

}  // namespace

std::string mean_colour_onnx(int side) {
    std::string graph, operators, out;
    put(graph, 1, node("GlobalAveragePool", "picture", "mean"));
    put(graph, 1, node("Flatten", "mean", "vector"));
    put(graph, 2, "mean colour");
    put(graph, 11, value("picture", {1, 3, side, side}));
    put(graph, 12, value("vector", {1, 3}));
    put(operators, 1, "");
    put(operators, 2, 11);
    put(out, 1, 7);
    put(out, 8, operators);
    put(out, 7, graph);
    return out;
}

}  // namespace weft
