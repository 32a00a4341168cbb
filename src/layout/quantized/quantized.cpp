// Boxes in six bytes and links in one bit: Kilian 2021 after Mahovsky, Wyvill 2006 and Jacobson 1989; spec 004,
// sections 2.6 and 2.7.
#include <fmt/format.h>

#include "boxwood/error.h"
#include "layout/encode_level.h"
#include "layout/quantized/quantized_nodes.h"
#include "layout/quantized/stages.h"

namespace boxwood {
namespace {

struct ChoosePointers {
  auto operator()(const Level<QuantizedPointers, TriangleLeaves>&, const TraceOptions& trace) const {
    return quantized_pointer_triangle_kernels(trace);
  }
  auto operator()(const Level<QuantizedPointers, InstanceLeaves>&, const TraceOptions& trace) const {
    return quantized_pointer_instance_kernels(trace);
  }
};

struct ChooseChunks {
  QuantizedForm form;
  bool parent;

  auto operator()(const Level<QuantizedChunks, TriangleLeaves>&, const TraceOptions& trace) const {
    if (form == QuantizedForm::free) return quantized_free_triangle_kernels(trace);
    if (form == QuantizedForm::milestones) return quantized_milestone_triangle_kernels(trace);
    return parent ? quantized_parent_triangle_kernels(trace) : quantized_chunk_triangle_kernels(trace);
  }
  auto operator()(const Level<QuantizedChunks, InstanceLeaves>&, const TraceOptions& trace) const {
    if (form == QuantizedForm::free) return quantized_free_instance_kernels(trace);
    if (form == QuantizedForm::milestones) return quantized_milestone_instance_kernels(trace);
    return parent ? quantized_parent_instance_kernels(trace) : quantized_chunk_instance_kernels(trace);
  }
};

void check(const QuantizedOptions& options) {
  if (options.fill != QuantizedFill::visits && options.form != QuantizedForm::free) {
    throw UsageError("'quantized' can choose how chunks are filled only with form=free; leave out 'fill'");
  }
  const bool one_frame = options.form == QuantizedForm::free || options.form == QuantizedForm::milestones;
  if (one_frame && options.frame != QuantizedFrame::chunk) {
    throw UsageError("'quantized' has frame=parent only with form=chunks and form=pointers; leave out 'frame'");
  }
  if (options.form == QuantizedForm::milestones && options.chunk != QuantizedChunkBytes::b64) {
    throw UsageError("'quantized(form=milestones)' has no chunks; leave out 'chunk'");
  }
  if (options.form != QuantizedForm::pointers) return;
  if (options.k != QuantizedArity::k2) throw UsageError("'quantized(form=pointers)' is binary; leave out 'k'");
  if (options.frame != QuantizedFrame::parent || options.chunk != QuantizedChunkBytes::b64) {
    throw UsageError(
        "'quantized(form=pointers)' has no chunks: write frame=parent, which keys are then relative to, and leave out "
        "'chunk'");
  }
}

std::shared_ptr<const Layout> encode_quantized(const QuantizedOptions& options, Tree tree, const Contents& contents,
                                               const TraceOptions& trace) {
  check(options);
  if (options.form == QuantizedForm::pointers) {
    return encode_level(
        std::move(tree), contents, trace, [](const Tree& t) { return encode_quantized_pointers(t); }, ChoosePointers{});
  }
  // Leaves are numbered with the chunks, so these come first.
  QuantizedChunks nodes = encode_quantized_chunks(tree, options);
  return encode_level(
      std::move(tree), contents, trace, [&](const Tree&) { return std::move(nodes); },
      ChooseChunks{options.form, options.frame == QuantizedFrame::parent});
}

}  // namespace

Stage quantized_stage() {
  return layout_stage<QuantizedOptions>(
      "quantized", "boxes in six bytes, links in one bit, two, or 32",
      "Kilian 2021, after Mahovsky, Wyvill 2006; spec 004",
      OptionsOf<QuantizedOptions>()
          .choice("k", &QuantizedOptions::k, {"2", "4", "8"}, "children per node; with form=pointers 2")
          .positional()
          .choice("form", &QuantizedOptions::form, {"chunks", "free", "milestones", "pointers"},
                  "one bit per node in chunks; two bits per node in chunks filled freely; one bit per node in one "
                  "field, with a count and a frame every 64; 16-byte nodes with pointers")
          .choice("frame", &QuantizedOptions::frame, {"chunk", "parent"},
                  "what boxes are relative to: their chunk's root, or their parent as decoded")
          .choice("chunk", &QuantizedOptions::chunk, {"64", "128"}, "bytes of a chunk")
          .choice("fill", &QuantizedOptions::fill, {"visits", "packed"},
                  "with form=free: a chunk takes what rays enter most likely, or as much as can be"),
      encode_quantized, [](const QuantizedOptions& options) { return options.arity(); });
}

}  // namespace boxwood
