// SPDX-License-Identifier: BSD-3-Clause
#include "AvlList.h"

#include <algorithm>

namespace neuralmesh
{
VertexIndex AvlList::at(std::size_t position) const
{
  const Node* node = this->root_.get();
  for (;;)
  {
    const std::size_t before = countOf(node->left);
    if (position == before)
    {
      return node->vertex;
    }
    if (position < before)
    {
      node = node->left.get();
    }
    else
    {
      position -= before + 1;
      node = node->right.get();
    }
  }
}

std::size_t AvlList::position(VertexIndex v) const
{
  const Node* node = this->nodeOf_.at(v);
  std::size_t position = countOf(node->left);
  for (; node->parent; node = node->parent)
  {
    if (node == node->parent->right.get())
    {
      position += countOf(node->parent->left) + 1;
    }
  }
  return position;
}

void AvlList::insert(VertexIndex v, std::size_t position)
{
  auto node = std::make_unique<Node>();
  node->vertex = v;
  this->nodeOf_[v] = node.get();
  this->insertAt(this->root_, std::move(node), position);
  this->root_->parent = nullptr;
}

void AvlList::jump(VertexIndex v, std::size_t distance)
{
  const std::size_t position = std::min(this->position(v) + distance, this->size() - 1);
  this->erase(v);
  this->insert(v, position);
}

void AvlList::insertAt(Tree& tree, Tree node, std::size_t position)
{
  if (!tree)
  {
    tree = std::move(node);
    return;
  }
  const std::size_t before = countOf(tree->left);
  if (position <= before)
  {
    this->insertAt(tree->left, std::move(node), position);
  }
  else
  {
    this->insertAt(tree->right, std::move(node), position - before - 1);
  }
  balance(tree);
}

void AvlList::eraseAt(Tree& tree, std::size_t position)
{
  const std::size_t before = countOf(tree->left);
  if (position < before)
  {
    this->eraseAt(tree->left, position);
  }
  else if (position > before)
  {
    this->eraseAt(tree->right, position - before - 1);
  }
  else if (tree->left && tree->right)
  {
    // The one behind takes its place.
    const Node* next = tree->right.get();
    while (next->left)
    {
      next = next->left.get();
    }
    const VertexIndex moved = next->vertex;
    this->nodeOf_.erase(tree->vertex);
    this->eraseAt(tree->right, 0);
    tree->vertex = moved;
    this->nodeOf_[moved] = tree.get();
  }
  else
  {
    this->nodeOf_.erase(tree->vertex);
    Node* parent = tree->parent;
    tree = std::move(tree->left ? tree->left : tree->right);
    if (tree)
    {
      tree->parent = parent;
    }
    return;
  }
  balance(tree);
}

void AvlList::update(Node& node)
{
  node.count = 1 + countOf(node.left) + countOf(node.right);
  node.height = 1 + std::max(heightOf(node.left), heightOf(node.right));
  for (const Tree* child : { &node.left, &node.right })
  {
    if (*child)
    {
      (*child)->parent = &node;
    }
  }
}

void AvlList::rotateLeft(Tree& tree)
{
  Node* parent = tree->parent;
  Tree top = std::move(tree->right);
  tree->right = std::move(top->left);
  update(*tree);
  top->left = std::move(tree);
  tree = std::move(top);
  tree->parent = parent;
  update(*tree);
}

void AvlList::rotateRight(Tree& tree)
{
  Node* parent = tree->parent;
  Tree top = std::move(tree->left);
  tree->left = std::move(top->right);
  update(*tree);
  top->right = std::move(tree);
  tree = std::move(top);
  tree->parent = parent;
  update(*tree);
}

void AvlList::balance(Tree& tree)
{
  update(*tree);
  const int lean = heightOf(tree->left) - heightOf(tree->right);
  if (lean > 1)
  {
    if (heightOf(tree->left->left) < heightOf(tree->left->right))
    {
      rotateLeft(tree->left);
    }
    rotateRight(tree);
  }
  else if (lean < -1)
  {
    if (heightOf(tree->right->right) < heightOf(tree->right->left))
    {
      rotateRight(tree->right);
    }
    rotateLeft(tree);
  }
}
}
