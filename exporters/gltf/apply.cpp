// Which material gets what, and the texts that follow.
#include "exporters/gltf/apply.hpp"

#include <algorithm>
#include <cstring>

#include "exporters/gltf/attributes.hpp"
#include "exporters/gltf/document.hpp"
#include "exporters/gltf/material.hpp"
#include "io/file_error.hpp"
#include "io/near_names.hpp"

namespace
{

// The renderer's name of the material that primitives without one have.
constexpr const char *default_name = "default";

class applier
{
  public:
    applier(const glint_export_gltf_options &options, export_container &file, report *r)
        : options_(options), file_(file), report_(r), reading_(options.input, file, r), patch_(text_of(file)),
          data_(patch_, file), packer_(patch_, data_, reading_.images_and_materials),
          materials_(patch_.text().member(json_text::root, "materials"))
    {
        const scene &s = reading_.images_and_materials;
        for (int i = 0; i < s.material_count; i++)
            names_.emplace_back(s.materials[i].name);
    }

    ordered_json run()
    {
        choose_presets();
        for (const auto &[index, preset] : chosen_)
            take_preset(index, preset);
        for (size_t i = 0; i < options_.value_count; i++)
            set(options_.values[i]);
        for (const auto &[index, text] : changed_)
            write(index, text);
        const attribute_count added = add_missing_attributes(reading_.file, raws(), count(), patch_, data_);
        data_.finish(file_);
        if (file_.glb && file_.padding != export_padding(file_) && !patch_.record().json_padding)
            patch_.record().json_padding = file_.padding;
        const std::string text = patch_.result();
        if (text != file_.text) {
            file_.text = text;
            file_.padding = export_padding(file_);
        }
        return {
            { "materials", done_ },
            { "added",
              { { "textures", packer_.added() }, { "tangents", added.tangents }, { "texcoords", added.texcoords } } }
        };
    }

  private:
    // The patch needs a text that stays while the file's own changes.
    std::string_view text_of(const export_container &file)
    {
        original_ = file.text;
        return original_;
    }

    // Materials of the file; the index behind them stands for primitives without a material.
    size_t count() const
    {
        return materials_ == json_text::none ? 0 : patch_.text().node(materials_).child_count;
    }

    std::map<size_t, std::string> raws() const
    {
        std::map<size_t, std::string> all;
        for (const auto &[index, text] : changed_)
            all[index] = text.raw;
        return all;
    }

    // As preset_apply does it: the last assignment that fits a material counts.
    void choose_presets()
    {
        for (size_t i = 0; i < options_.material_count; i++) {
            const glint_export_assignment &a = options_.materials[i];
            bool fits = std::strcmp(a.name, "*") == 0;
            for (size_t m = 0; m < names_.size(); m++)
                if (std::strcmp(a.name, "*") == 0 || names_[m] == a.name) {
                    chosen_[m] = a.value;
                    fits = true;
                }
            if (!fits)
                throw file_error("", std::string("found no material called \"") + a.name + "\"" +
                                         names_instead(a.name, names_));
        }
    }

    material_text &changed(size_t index)
    {
        const auto known = changed_.find(index);
        if (known != changed_.end())
            return known->second;
        const uint32_t n = patch_.text().element(materials_, index);
        const std::string raw = n == json_text::none ? "{\"name\":\"" + std::string(default_name) + "\"}"
                                                     : std::string(patch_.text().value(n));
        const size_t level = 2; // root, array, material
        return changed_[index] = { n == json_text::none ? json_layout(raw, patch_.text().style(), level) : raw,
                                   patch_.text().style(), level };
    }

    void take_preset(size_t index, const std::string &name)
    {
        const auto known = presets_.find(name);
        if (known == presets_.end()) {
            const export_preset preset = export_read_preset(name, report_);
            presets_[name] = preset_with_textures(preset, packer_);
        }
        material_take_preset(changed(index), presets_[name]);
        done_.push_back({ { "index", index }, { "name", names_[index] }, { "preset", name } });
    }

    void set(const glint_export_assignment &value)
    {
        const std::string pointer = value.name;
        if (pointer.compare(0, 11, "/materials/") == 0) {
            const size_t end = std::min(pointer.find('/', 11), pointer.size());
            const uint32_t n = patch_.text().find(pointer.substr(0, end));
            if (n == json_text::none)
                throw file_error("", "found the pointer " + pointer + " to a material, of which there are " +
                                         std::to_string(count()));
            material_set(changed(std::stoul(pointer.substr(11, end - 11))), pointer.substr(end), value.value);
            return;
        }
        if (pointer.empty() || pointer[0] != '/')
            throw file_error("", "found \"" + pointer + "\", expected a JSON pointer, which starts with a slash");
        for (const size_t index : with_extension())
            material_set(changed(index), std::string("/extensions/") + glint_extension + pointer, value.value);
    }

    // What a pointer into the extension alone means.
    std::vector<size_t> with_extension() const
    {
        std::vector<size_t> all;
        if (options_.material_count > 0) {
            for (const auto &preset : chosen_)
                all.push_back(preset.first);
            return all;
        }
        for (size_t i = 0; i < count(); i++) {
            const uint32_t n = patch_.text().element(materials_, i);
            const uint32_t extensions = patch_.text().member(n, "extensions");
            if (patch_.text().member(extensions, glint_extension) != json_text::none)
                all.push_back(i);
        }
        if (all.empty())
            throw file_error("", std::string("found no material with ") + glint_extension +
                                     ", expected one; --material puts a preset on a material");
        return all;
    }

    void write(size_t index, const material_text &text)
    {
        for (const std::string &name : material_extension_names(text.raw))
            patch_.use_extension(name);
        const uint32_t n = patch_.text().element(materials_, index);
        if (n != json_text::none)
            patch_.replace(n, text.raw);
        else
            give_to_primitives(patch_.add_element("materials", text.raw));
    }

    void give_to_primitives(size_t material)
    {
        const json_text &text = patch_.text();
        const uint32_t meshes = text.member(json_text::root, "meshes");
        for (uint32_t mesh = text.node(meshes).first_child; mesh != json_text::none; mesh = text.node(mesh).next) {
            const uint32_t primitives = text.member(mesh, "primitives");
            for (uint32_t n = text.node(primitives).first_child; n != json_text::none; n = text.node(n).next)
                if (text.member(n, "material") == json_text::none)
                    patch_.add_member(n, "material", std::to_string(material));
        }
    }

    const glint_export_gltf_options &options_;
    export_container &file_;
    report *report_;
    std::string original_;
    export_reading reading_;
    patch patch_;
    export_data data_;
    texture_packer packer_;
    uint32_t materials_;
    std::vector<std::string> names_;
    std::map<size_t, std::string> chosen_;
    std::map<std::string, std::string> presets_;
    std::map<size_t, material_text> changed_;
    ordered_json done_ = ordered_json::array();
};

} // namespace

ordered_json export_apply(const glint_export_gltf_options &options, export_container &file, report *r)
{
    return applier(options, file, r).run();
}
