// Directives that say what comes after them looks like, and those that save and restore it.
#include "scene/pbrt/reader.h"

namespace onde::pbrt {

static constexpr size_t MAX_NESTING = 1024;

void Reader::save(char kind) {
    if (saved_.size() == MAX_NESTING)
        fail(fmt::format("attributes are nested more than {} deep; flatten them", MAX_NESTING));
    saved_.emplace_back(kind, state_);
}

void Reader::restore(char kind) {
    if (saved_.empty() || saved_.back().first != kind)
        return notes_.wrong("Ends of what has not begun are left out", tokens_->where());
    state_ = saved_.back().second;
    saved_.pop_back();
}

void Reader::attribute_begin() {
    save(directive_.front());
}

void Reader::attribute_end() {
    restore('A');
}

void Reader::transform_end() {
    State kept = state_;
    const size_t depth = saved_.size();
    restore('T');
    if (saved_.size() == depth) return;
    kept.transform = state_.transform;
    kept.moves_start = state_.moves_start;
    state_ = kept;
}

void Reader::reverse_orientation() {
    state_.is_reversed = !state_.is_reversed;
}

uint32_t Reader::number_of_material(const std::string& name) {
    const auto [found, is_new] = material_of_name_.try_emplace(name, uint32_t(materials_.size()));
    if (is_new) materials_.push_back({name, "", {}});
    return found->second;
}

void Reader::material() {
    const std::string kind = text("a kind of material");
    state_.material = uint32_t(materials_.size());
    materials_.push_back({"", kind.empty() ? "interface" : kind, parameters()});
}

void Reader::make_named_material() {
    const std::string name = text("a name");
    Parameters p = parameters();
    MaterialSource& source = materials_[number_of_material(name)];
    source.kind = p.text("type").value_or("diffuse");
    if (source.kind.empty()) source.kind = "interface";
    source.parameters = std::move(p);
}

void Reader::named_material() {
    state_.material = number_of_material(text("a name"));
}

void Reader::texture() {
    const std::string name = text("a name"), type = text("float or spectrum");
    const std::string kind = text("a kind of texture");
    textures_.define(name, kind, parameters());
}

void Reader::area_light_source() {
    const std::string kind = text("a kind of light");
    state_.area_light = int64_t(area_lights_.size());
    area_lights_.push_back(area_light_of(kind, parameters(), sources_));
}

void Reader::light_source() {
    const std::string kind = text("a kind of light");
    const Parameters p = parameters();
    add_light(kind, p, state_.transform, scene_, sky_, sources_);
}

} // namespace onde::pbrt
