/* All that OpenImageIO does for us: image files in, decoded textures, filtered lookups. */
#include <cstring>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/texture.h>

#include "io/image_bytes.h"
#include "io/image_engine.h"
#include "io/image_srgb.h"
#include "io/texture_transform.h"

namespace
{

/* Runs work and turns what it throws into an error about name. */
template <class Work> bool guarded(const char *name, report *r, Work work) noexcept
{
    try {
        return work();
    } catch (const std::bad_alloc &) {
        return report_error(r, "%s: does not fit into memory", name);
    } catch (const std::exception &problem) {
        return report_error(r, "%s: %s", name, problem.what());
    } catch (...) {
        return report_error(r, "%s: OpenImageIO failed without saying why", name);
    }
}

/* OpenImageIO separates several messages by line breaks; ours are one line. */
std::string one_line(std::string text)
{
    text.erase(text.find_last_not_of('\n') + 1);
    for (size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n'))
        text.replace(end, 1, "; ");
    return text;
}

/* Alpha stays as the file has it, straight in all formats but OpenEXR. NULL after an error. */
std::unique_ptr<OIIO::ImageInput> open_input(const char *format, const std::string &path, OIIO::ImageSpec config,
                                             const char *name, report *r)
{
    config.attribute("oiio:UnassociatedAlpha", 1);
    auto file = OIIO::ImageInput::create(format);
    OIIO::ImageSpec spec;
    if (file && file->open(path, spec, config))
        return file;
    report_error(r, "%s: is broken: %s", name, one_line(file ? file->geterror() : OIIO::geterror()).c_str());
    return nullptr;
}

/* ---- pictures in ---- */

bool read_picture(const char *path, image *out, report *r)
{
    const char *format = image_file_format(path, r);
    const auto file = format ? open_input(format, path, OIIO::ImageSpec(), path, r) : nullptr;
    if (!file)
        return false;
    const OIIO::ImageSpec &spec = file->spec();
    if (spec.depth > 1 || spec.deep)
        return report_error(r, "%s: is a volume or a deep image, expected a flat one", path);
    report size = {};
    if (!image_allocate(out, spec.width, spec.height, spec.nchannels, &size))
        return report_error(r, "%s: %s", path, size.error);
    for (int c = 0; c < spec.nchannels; c++)
        if (!image_name_channel(out, c, spec.channelnames[static_cast<size_t>(c)].c_str(), path, r))
            return false;
    if (!file->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, out->pixels) || file->has_error())
        return report_error(r, "%s: is broken: %s", path, one_line(file->geterror()).c_str());
    if (spec.width != spec.full_width || spec.height != spec.full_height || spec.x != spec.full_x ||
        spec.y != spec.full_y) {
        out->x = spec.x - spec.full_x;
        out->y = spec.y - spec.full_y;
        out->full_width = spec.full_width;
        out->full_height = spec.full_height;
    }
    if (spec.format.basetype == OIIO::TypeDesc::UINT8 || spec.format.basetype == OIIO::TypeDesc::UINT16)
        image_from_srgb(out, spec.alpha_channel);
    return true;
}

/* ---- textures ---- */

/* Shows a mipmap to the image cache as if it were a file. The cache has every level as one tile of ours from the start,
 * so it asks for sizes only, unless it drops a tile. */
class mipmap_input final : public OIIO::ImageInput
{
  public:
    const char *format_name() const override
    {
        return "glint mipmap";
    }
    bool open(const std::string &, OIIO::ImageSpec &) override
    {
        return false; /* the mipmap comes with the configuration */
    }
    bool open(const std::string &, OIIO::ImageSpec &spec, const OIIO::ImageSpec &config) override
    {
        const OIIO::ParamValue *given = config.find_attribute(attribute_name, OIIO::TypeDesc::PTR);
        if (!given)
            return false;
        source_ = *static_cast<const mipmap *const *>(given->data());
        seek_subimage(0, 0);
        spec = m_spec;
        return true;
    }
    bool close() override
    {
        source_ = nullptr;
        return true;
    }
    int current_miplevel() const override
    {
        return level_;
    }
    bool seek_subimage(int subimage, int level) override
    {
        if (!source_ || subimage != 0 || level < 0 || level >= source_->level_count)
            return false;
        level_ = level;
        m_spec = OIIO::ImageSpec(source_->levels[level].width, source_->levels[level].height, source_->channel_count,
                                 texel_type(*source_));
        return true;
    }
    bool read_native_scanline(int subimage, int level, int y, int, void *data) override
    {
        if (!seek_subimage(subimage, level) || y < 0 || y >= m_spec.height)
            return false;
        const size_t row_size = static_cast<size_t>(m_spec.width) * static_cast<size_t>(m_spec.nchannels);
        std::memcpy(data, source_->levels[level].texels + static_cast<size_t>(y) * row_size,
                    row_size * sizeof(uint16_t));
        return true;
    }

    static OIIO::TypeDesc texel_type(const mipmap &m)
    {
        return m.coding == MIPMAP_HALF ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::UINT16;
    }
    static constexpr const char *attribute_name = "glint:mipmap";

  private:
    const mipmap *source_ = nullptr;
    int level_ = 0;
};

/* Decodes into level 0 as 16-bit integers; 8-bit codes v become 257 v, the same fraction. */
bool decode_texels(const image_bytes &bytes, const char *name, mipmap *out, report *r)
{
    OIIO::Filesystem::IOMemReader reader(bytes.bytes, bytes.byte_count);
    OIIO::Filesystem::IOProxy *proxy = &reader;
    OIIO::ImageSpec config;
    config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    const auto file = open_input(bytes.format, std::string("texture.") + bytes.format, config, name, r);
    if (!file)
        return false;
    const OIIO::ImageSpec &spec = file->spec();
    if (spec.nchannels < 1 || spec.nchannels > 4)
        return report_error(r, "%s: has %d channels, expected 1 to 4", name, spec.nchannels);
    const int channel_count = spec.nchannels == 2 ? 4 : spec.nchannels;
    if (!mipmap_allocate(out, spec.width, spec.height, channel_count, name, r))
        return false;
    const bool read = file->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT16, out->levels[0].texels,
                                       static_cast<OIIO::stride_t>(sizeof(uint16_t)) * channel_count);
    const std::string complaint = one_line(file->geterror());
    /* The JPEG reader fills what is missing with grey and calls it success. */
    if (!read || complaint.find("Premature end") != std::string::npos)
        return report_error(r, "%s: is broken: %s", name, complaint.c_str());
    if (!complaint.empty())
        report_warning(r, "%s: %s", name, complaint.c_str());
    if (spec.nchannels == 2)
        mipmap_spread_grey(out);
    return true;
}

bool decode(const scene_image *picture, mipmap *out, report *r)
{
    if (picture->texels)
        return mipmap_copy(picture, out, r);
    image_bytes bytes;
    if (!image_bytes_load(picture, &bytes, r))
        return false;
    const bool decoded = guarded(picture->name, r, [&] { return decode_texels(bytes, picture->name, out, r); });
    image_bytes_free(&bytes);
    return decoded;
}

bool load_mipmap(const scene_image &picture, bool srgb, mipmap *out, report *r)
{
    if (!decode(&picture, out, r))
        return false;
    if (srgb && !mipmap_decode_srgb(out))
        return report_error(r, "%s: does not fit into memory", picture.name);
    mipmap_build(out);
    return true;
}

/* By scene_wrap. */
constexpr OIIO::TextureOpt::Wrap wrap_modes[] = { OIIO::TextureOpt::WrapPeriodic, OIIO::TextureOpt::WrapClamp,
                                                  OIIO::TextureOpt::WrapMirror };

/* An image as data or as colour; without levels where no material uses it so. */
struct texture_source {
    mipmap texels{};
    OIIO::TextureSystem::TextureHandle *handle = nullptr;
};

} // namespace

struct engine_textures {
    explicit engine_textures(int image_count) : sources(2 * static_cast<size_t>(image_count))
    {
        cache = OIIO::ImageCache::create(false);
        system = OIIO::TextureSystem::create(false, cache);
        system->attribute("gray_to_rgb", 1);
    }
    engine_textures(const engine_textures &) = delete;
    engine_textures &operator=(const engine_textures &) = delete;
    ~engine_textures()
    {
        /* TextureSystem::destroy of OpenImageIO 2.4 tells the allocator that the object is one byte long. glibc does
         * not listen; jemalloc, which Blender runs on, believes it and breaks its heap. */
        system->~TextureSystem();
        ::operator delete(system);
        OIIO::ImageCache::destroy(cache);
        for (texture_source &source : sources)
            mipmap_free(&source.texels);
    }

    static size_t index(const scene_texture &use)
    {
        return 2 * static_cast<size_t>(use.image) + (use.srgb ? 1 : 0);
    }

    bool open(const scene &s, const scene_texture &use, report *r)
    {
        texture_source &source = sources[index(use)];
        const scene_image &picture = s.images[use.image];
        return source.handle || (load_mipmap(picture, use.srgb, &source.texels, r) && add(index(use), picture.name, r));
    }

    /* Hands every level over as one tile that stays where it is. */
    bool add(size_t number, const char *image_name, report *r)
    {
        texture_source &source = sources[number];
        const mipmap *texels = &source.texels;
        const OIIO::ustring name = OIIO::ustring::fmtformat("texture {}", number);
        OIIO::ImageSpec config;
        config.attribute(mipmap_input::attribute_name, OIIO::TypeDesc::PTR, &texels);
        bool done = cache->add_file(
            name, []() -> OIIO::ImageInput * { return new mipmap_input; }, &config);
        for (int l = 0; done && l < texels->level_count; l++)
            done =
                cache->add_tile(name, 0, l, 0, 0, 0, 0, texels->channel_count, mipmap_input::texel_type(*texels),
                                texels->levels[l].texels, OIIO::AutoStride, OIIO::AutoStride, OIIO::AutoStride, false);
        source.handle = done ? system->get_texture_handle(name) : nullptr;
        if (!source.handle)
            return report_error(r, "%s: the texture cache refuses it: %s", image_name,
                                one_line(cache->geterror()).c_str());
        return true;
    }

    OIIO::ImageCache *cache;
    OIIO::TextureSystem *system;
    std::vector<texture_source> sources;
};

namespace
{

bool read(const char *path, image *out, report *r)
{
    *out = image{};
    if (guarded(path, r, [&] { return read_picture(path, out, r); }))
        return true;
    image_free(out);
    return false;
}

bool open_textures(const scene *s, engine_textures **out, report *r)
{
    *out = nullptr;
    return guarded("textures", r, [&] {
        auto opened = std::make_unique<engine_textures>(s->image_count);
        for (int m = 0; m < s->material_count; m++) {
            const scene_texture *uses[SCENE_MATERIAL_TEXTURES];
            scene_material_textures(&s->materials[m], uses);
            for (const scene_texture *use : uses)
                if (use->image != SCENE_NONE && !opened->open(*s, *use, r))
                    return false;
        }
        *out = opened.release();
        return true;
    });
}

void close_textures(engine_textures *t)
{
    delete t;
}

void lookup(const engine_textures *t, const scene_texture *which, float s, float t_, float dsdx, float dtdx, float dsdy,
            float dtdy, float rgba[4])
{
    rgba[0] = rgba[1] = rgba[2] = rgba[3] = 1.0F;
    const texture_point uv = { s, t_, dsdx, dtdx, dsdy, dtdy };
    const texture_point p = texture_transform(which, &uv);
    OIIO::TextureOpt options;
    options.swrap = wrap_modes[which->wrap_s];
    options.twrap = wrap_modes[which->wrap_t];
    options.mipmode = which->nearest ? OIIO::TextureOpt::MipModeNoMIP : OIIO::TextureOpt::MipModeAniso;
    options.interpmode = which->nearest ? OIIO::TextureOpt::InterpClosest : OIIO::TextureOpt::InterpBilinear;
    options.fill = 1.0F; /* alpha, where the image has none */
    try {
        t->system->texture(t->sources[engine_textures::index(*which)].handle, t->system->get_perthread_info(), options,
                           p.s, p.t, p.dsdx, p.dtdx, p.dsdy, p.dtdy, 4, rgba);
    } catch (const std::bad_alloc &) {
        /* A thread's first lookup finds no memory for its own part of the cache: white, as without a texture. */
    }
}

constexpr image_engine engine = { sizeof(image_engine), read, decode, open_textures, close_textures, lookup };

} // namespace

const image_engine *glint_image_engine(void)
{
    return &engine;
}
