// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Ring.h"

#include <cstddef>
#include <map>
#include <memory>

namespace neuralmesh
{
/// The activity list as the thesis has it: an AVL tree with the counts of its subtrees, and a map
/// from vertices to nodes. Only to compare with.
class AvlList
{
public:
  std::size_t size() const { return countOf(this->root_); }
  VertexIndex at(std::size_t position) const;
  std::size_t position(VertexIndex v) const;
  void insert(VertexIndex v, std::size_t position);
  void erase(VertexIndex v) { this->eraseAt(this->root_, this->position(v)); }
  void jump(VertexIndex v, std::size_t distance);

private:
  struct Node
  {
    VertexIndex vertex;
    std::size_t count = 1;
    int height = 1;
    Node* parent = nullptr;
    std::unique_ptr<Node> left;
    std::unique_ptr<Node> right;
  };
  using Tree = std::unique_ptr<Node>;

  static std::size_t countOf(const Tree& tree) { return tree ? tree->count : 0; }
  static int heightOf(const Tree& tree) { return tree ? tree->height : 0; }
  static void update(Node& node);
  static void rotateLeft(Tree& tree);
  static void rotateRight(Tree& tree);
  static void balance(Tree& tree);

  void insertAt(Tree& tree, Tree node, std::size_t position);
  void eraseAt(Tree& tree, std::size_t position);

  Tree root_;
  std::map<VertexIndex, Node*> nodeOf_;
};
}
