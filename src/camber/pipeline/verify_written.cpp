#include <camber/base/error.hpp>
#include <camber/mesh/element_list.hpp>
#include <camber/pipeline/check.hpp>
#include <camber/validity/batch.hpp>

#include <algorithm>
#include <cstring>
#include <functional>
#include <map>
#include <tuple>

#include <fmt/format.h>

namespace camber {
namespace {

/// Elements of one shape, order and entity, over all blocks: formats may split or join blocks.
using Kind = std::tuple<int, Shape, int>;
struct Elements {
  std::vector<const ElementBlock*> blocks;
  std::size_t nodes = 0;
  bool has_tags = false;
};

std::map<Kind, Elements> by_kind(const MeshData& mesh) {
  std::map<Kind, Elements> kinds;
  for (const ElementBlock& block : mesh.blocks) {
    if (block.nodes.empty()) continue;
    Elements& all = kinds[{block.entity, block.shape, block.order}];
    all.blocks.push_back(&block);
    all.nodes += block.nodes.size();
    all.has_tags = all.has_tags || !block.tags.empty();
  }
  return kinds;
}

/// Goes through one list of all blocks of a kind, block after block.
template <class T>
class Walk {
 public:
  Walk(const std::vector<const ElementBlock*>& blocks, std::vector<T> ElementBlock::*list)
      : blocks_(blocks), list_(list) {}
  /// The next value, or null behind the last.
  const T* next() {
    for (; block_ < blocks_.size(); ++block_, place_ = 0) {
      const std::vector<T>& values = blocks_[block_]->*list_;
      if (place_ < values.size()) return &values[place_++];
    }
    return nullptr;
  }

 private:
  const std::vector<const ElementBlock*>& blocks_;
  std::vector<T> ElementBlock::*list_;
  std::size_t block_ = 0, place_ = 0;
};

/// Both have the same values in the same order; `same` compares two of them.
template <class T, class Same>
bool walk_both(const Elements& a, const Elements& b, std::vector<T> ElementBlock::*list,
               const Same& same) {
  Walk<T> in_a(a.blocks, list), in_b(b.blocks, list);
  for (;;) {
    const T *const x = in_a.next(), *const y = in_b.next();
    if (!x || !y) return x == y;
    if (!same(*x, *y)) return false;
  }
}

[[noreturn]] void differs(const MeshData& written, const std::string& what) {
  throw FileError("what was written differs from the mesh: " + what, written.source,
                  "check the disk");
}

bool same_bits(const Vec3& a, const Vec3& b) {
  return std::memcmp(a.data(), b.data(), 3 * sizeof(double)) == 0;
}

/// Pairs the nodes of both meshes one to one as their elements name them.
class NodePairs {
 public:
  NodePairs(const MeshData& written, const MeshData& read_back)
      : written_(written),
        read_back_(read_back),
        to_read_(written.points.size(), k_none),
        to_written_(read_back.points.size(), k_none) {}

  void pair(Index w, Index r) {
    if (to_read_[at(w)] == r && to_written_[at(r)] == w) return;
    if (to_read_[at(w)] != k_none || to_written_[at(r)] != k_none) {
      differs(written_, "elements share other nodes");
    }
    if (!same_bits(written_.points[at(w)], read_back_.points[at(r)])) {
      differs(written_, fmt::format("point {} has moved", w + 1));
    }
    to_read_[at(w)] = r;
    to_written_[at(r)] = w;
  }

 private:
  const MeshData &written_, &read_back_;
  std::vector<Index> to_read_, to_written_;
};

void compare(const MeshData& written, const MeshData& read_back) {
  if (written.points.size() != read_back.points.size()) {
    differs(written,
            fmt::format("{} points instead of {}", read_back.points.size(), written.points.size()));
  }
  const std::map<Kind, Elements> wanted = by_kind(written), found = by_kind(read_back);
  if (wanted.size() != found.size()) differs(written, "other kinds of elements");
  NodePairs nodes(written, read_back);
  for (const auto& [kind, elements] : wanted) {
    const auto [entity, shape, order] = kind;
    const auto other = found.find(kind);
    if (other == found.end() || other->second.nodes != elements.nodes) {
      differs(written, fmt::format("other number of {} elements of order {} on entity {}",
                                   name(shape), order, entity));
    }
    if (elements.has_tags &&
        !walk_both(elements, other->second, &ElementBlock::tags, std::equal_to<GlobalId>())) {
      differs(written, fmt::format("other numbers of {} elements", name(shape)));
    }
    walk_both(elements, other->second, &ElementBlock::nodes, [&](Index w, Index r) {
      nodes.pair(w, r);
      return true;
    });
  }
}

void require_certified(const MeshData& written, const MeshData& read_back) {
  const ElementList cells(read_back, 3);
  std::vector<std::size_t> curved;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells.order(i) > 1) curved.push_back(i);
  }
  const std::vector<Verdict> verdicts =
      quick_verdicts(curved.size(), [&](std::size_t k, Points& nodes) {
        cells.gather(curved[k], nodes);
        return ElementKind{cells.shape(curved[k]), cells.order(curved[k])};
      });
  const auto bad =
      std::find_if(verdicts.begin(), verdicts.end(), [](Verdict v) { return v != Verdict::valid; });
  if (bad == verdicts.end()) return;
  const std::size_t i = curved[static_cast<std::size_t>(bad - verdicts.begin())];
  differs(written, fmt::format("{} {} is not certified", name(cells.shape(i)), cells.tag(i)));
}

}  // namespace

void verify_written(const MeshData& written, const MeshData& read_back, bool expect_certified) {
  compare(written, read_back);
  if (expect_certified) require_certified(written, read_back);
}

}  // namespace camber
