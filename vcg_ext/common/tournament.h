// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace dcharts {

/// Which of many players has the least key, of equal ones the first player. A tree of losers: when the
/// winner's key changes it meets only those who lost to it, and none while it is less than the least of
/// theirs.
class Tournament {
 public:
  static constexpr int kNobody = std::numeric_limits<int>::max();

  /// No player takes part at first.
  void Begin(int player_count) {
    leaves_ = 1;
    while (leaves_ < player_count) leaves_ *= 2;
    // A leaf's player, and an inner node's winner until Start() puts its loser there.
    nodes_.assign(2 * leaves_, {});
  }

  /// Before Start().
  void Enter(int player, double key) { nodes_[leaves_ + player] = {key, player}; }

  void Start() {
    for (int node = leaves_ - 1; node >= 1; --node)
      nodes_[node] = std::min(nodes_[2 * node], nodes_[2 * node + 1]);
    nodes_[0] = nodes_[1];
    for (int node = 1; node < leaves_; ++node)
      nodes_[node] = std::max(nodes_[2 * node], nodes_[2 * node + 1]);
    FindRunnerUp();
  }

  int Winner() const { return nodes_[0].player; }

  /// With this key the winner would win again, whoever it is.
  bool WinsAgain(double key) const { return key < runner_up_.key; }
  /// The winner goes on with another key.
  void Replay(double key) {
    const Node node{key, Winner()};
    if (!(node < runner_up_)) Meet(node);
  }
  /// The winner plays no more.
  void Leave() { Meet({}); }

 private:
  struct Node {
    double key = std::numeric_limits<double>::infinity();
    int player = kNobody;
    bool operator<(const Node& other) const {
      return key != other.key ? key < other.key : player < other.player;
    }
  };

  void Meet(Node node) {
    for (int k = (leaves_ + Winner()) / 2; k >= 1; k /= 2)
      if (nodes_[k] < node) std::swap(nodes_[k], node);
    nodes_[0] = node;
    FindRunnerUp();
  }

  // Who comes second has lost to the winner.
  void FindRunnerUp() {
    runner_up_ = {};
    if (Winner() == kNobody) return;
    for (int k = (leaves_ + Winner()) / 2; k >= 1; k /= 2) runner_up_ = std::min(runner_up_, nodes_[k]);
  }

  int leaves_ = 1;
  std::vector<Node> nodes_;  // 0: the winner
  Node runner_up_;
};

}  // namespace dcharts
