// A mean of two models, such as rays where they are known and the scene's interior where they are not. SAH alternatives
// study, section 6 (i).
#include "cost/models.h"

namespace boxwood {
namespace {

struct BlendOptions {
  CostChoice first, second;
  float weight = 0.5f;
};

struct Memories final : CostModel::Memory {
  std::shared_ptr<const Memory> first, second;
};

class Blend final : public CostModel {
 public:
  Blend(const BlendOptions& options, const CostContext& context)
      : first_(options.first.make(context)), second_(options.second.make(context)), weight_(options.weight) {}

  void probabilities(const Node& parent, std::span<const Side> sides, std::span<float> out) const override {
    std::vector<float> other(sides.size());
    first_->probabilities(node_of(parent, &Memories::first), sides, out);
    second_->probabilities(node_of(parent, &Memories::second), sides, other);
    mix(other, out);
  }

  void pair_probabilities(const Node& parent, std::span<const Side> left, std::span<const Side> right,
                          std::span<float> left_out, std::span<float> right_out) const override {
    std::vector<float> other_left(left.size()), other_right(left.size());
    first_->pair_probabilities(node_of(parent, &Memories::first), left, right, left_out, right_out);
    second_->pair_probabilities(node_of(parent, &Memories::second), left, right, other_left, other_right);
    mix(other_left, left_out);
    mix(other_right, right_out);
  }

  std::shared_ptr<const Memory> enter(const Box& node, const Memory* parent) const override {
    const auto* above = static_cast<const Memories*>(parent);
    auto memory = std::make_shared<Memories>();
    memory->first = first_->enter(node, above ? above->first.get() : nullptr);
    memory->second = second_->enter(node, above ? above->second.get() : nullptr);
    return memory;
  }
  bool is_surface_area(const Memory* memory) const override {
    const auto* both = static_cast<const Memories*>(memory);
    return first_->is_surface_area(both->first.get()) && second_->is_surface_area(both->second.get());
  }

 private:
  static Node node_of(const Node& node, std::shared_ptr<const Memory> Memories::*member) {
    Node own = node;
    own.memory = (static_cast<const Memories*>(node.memory)->*member).get();
    return own;
  }
  void mix(std::span<const float> other, std::span<float> out) const {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += weight_ * (other[i] - out[i]);
  }

  std::unique_ptr<CostModel> first_, second_;
  float weight_;
};

std::unique_ptr<CostModel> make(const BlendOptions& options, const CostContext& context) {
  return std::make_unique<Blend>(options, context);
}

}  // namespace

CostModelEntry blend_entry() {
  OptionsOf<BlendOptions> options;
  add_cost_choice(options, "first", &BlendOptions::first, "a model");
  options.positional();
  add_cost_choice(options, "second", &BlendOptions::second, "another");
  options.positional();
  options.real("weight", &BlendOptions::weight, 0, 1, "of the second; the first has the rest").positional();
  CostModelEntry entry = cost_model_entry<BlendOptions>("blend", "a weighted mean of two models",
                                                        "SAH alternatives study", options, false, make);
  entry.needs_use = [](const std::any& chosen) {
    const auto& blend = std::any_cast<const BlendOptions&>(chosen);
    return blend.first.needs_use() || blend.second.needs_use();
  };
  return entry;
}

}  // namespace boxwood
