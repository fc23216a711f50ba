#pragma once
// Pairs of patches that are copies of one another: their curved shapes are made equal.
#include <camber/elevate/order_rules.hpp>
#include <camber/mesh/curved_mesh.hpp>
#include <camber/pipeline/options.hpp>
#include <camber/pipeline/report.hpp>

#include <optional>
#include <string>
#include <vector>

namespace camber {

/// "NAME=OTHER", "NAME=OTHER:dx,dy,dz", or "NAME=OTHER:x,y,z,ax,ay,az,degrees" (a point and the
/// direction of the axis). @throws OptionError
[[nodiscard]] PeriodicPair parse_periodic(const std::string& text);

/// Partner entities of all pairs. Vertices match within 1e-6 of the mesh's size and are not moved.
class PeriodicMatch {
 public:
  /// @throws OptionError for an unknown patch or a motion that does not map one patch onto the
  /// other
  PeriodicMatch(const LinearMesh& mesh, const Topology& topology,
                const std::vector<PeriodicPair>& pairs);

  [[nodiscard]] bool is_empty() const { return rows_.empty(); }

  /// Partners ask for the order that either has, until none has more than the other.
  /// @param settle  orders from requests
  template <class Settle>
  [[nodiscard]] OrderField settle(OrderRequests& requests, const Settle& settle) const {
    OrderField orders = settle(requests);
    while (ask_for_partners(orders, requests)) orders = settle(requests);
    return orders;
  }

  /// Nodes of edges and faces of `to` become the images of their partners', to the bit. Where a
  /// cell would lose its certificate the entity keeps its nodes and is counted.
  void copy(CurvedMesh& curved);

  [[nodiscard]] const std::vector<PeriodicRow>& rows() const { return rows_; }

 private:
  struct Partner {
    Index from, to;
    std::size_t pair;
  };
  bool ask_for_partners(const OrderField& orders, OrderRequests& requests) const;
  void match(const LinearMesh& mesh, const Topology& topology, const PeriodicPair& pair);
  void copy_edge(CurvedMesh& curved, const Partner& partner) const;
  void copy_face(CurvedMesh& curved, const Partner& partner) const;

  std::vector<PeriodicRow> rows_;
  std::vector<Partner> edges_, faces_;
  std::vector<std::vector<Index>> image_;  // by pair: vertex -> partner or -1
};

}  // namespace camber
