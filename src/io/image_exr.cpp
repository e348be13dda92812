/* OpenEXR files out, and their metadata in, by the library of that name: the only file that includes it. */
#include <exception>
#include <new>
#include <thread>

#include <Iex.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>

#include "io/image_metadata.h"
#include "io/output_file.h"

namespace
{

/* From this many samples on several threads compress; fewer take one of them some milliseconds (taste). */
constexpr size_t threads_pay = size_t{ 1 } << 16;

/* Lets OpenEXR write through an output_file, which keeps the first error. */
class output_stream : public Imf::OStream
{
  public:
    output_stream(const char *path, output_file *file) : OStream(path), file_(file)
    {
    }
    void write(const char *data, int byte_count) override
    {
        output_file_write(file_, data, static_cast<size_t>(byte_count));
    }
    uint64_t tellp() override
    {
        return static_cast<uint64_t>(output_file_tell(file_));
    }
    void seekp(uint64_t position) override
    {
        output_file_seek(file_, static_cast<int64_t>(position));
    }

  private:
    output_file *file_;
};

Imf::Header header_of(const image *i, const image_text *metadata, size_t metadata_count)
{
    const bool whole = i->full_width == 0;
    const int width = whole ? i->width : i->full_width, height = whole ? i->height : i->full_height;
    const Imath::V2i first(i->x, i->y), last(i->x + i->width - 1, i->y + i->height - 1);
    Imf::Header header(width, height, Imath::Box2i(first, last));
    header.compression() = Imf::ZIP_COMPRESSION;
    for (int c = 0; c < i->channel_count; c++)
        header.channels().insert(i->channel_names[c], Imf::Channel(Imf::FLOAT));
    for (size_t m = 0; m < metadata_count; m++)
        header.insert(metadata[m].key, Imf::StringAttribute(metadata[m].value));
    return header;
}

void write_pixels(const image *i, const Imf::Header &header, output_stream &stream)
{
    const size_t pixel_size = static_cast<size_t>(i->channel_count) * sizeof(float);
    const size_t row_size = static_cast<size_t>(i->width) * pixel_size;
    const Imath::V2i first(i->x, i->y);
    Imf::FrameBuffer pixels;
    for (int c = 0; c < i->channel_count; c++) /* it reads through a pointer that might write */
        pixels.insert(i->channel_names[c],
                      Imf::Slice::Make(Imf::FLOAT, i->pixels + c, first, i->width, i->height, pixel_size, row_size));
    if (row_size / sizeof(float) * static_cast<size_t>(i->height) >= threads_pay)
        Imf::setGlobalThreadCount(static_cast<int>(std::thread::hardware_concurrency()));
    Imf::OutputFile file(stream, header, Imf::globalThreadCount());
    file.setFrameBuffer(pixels);
    file.writePixels(i->height);
}

/* A failure of the disk is left to the commit, which knows the system's reason. */
bool encode(const char *path, const image *i, const image_text *metadata, size_t metadata_count, output_file *file,
            report *r) noexcept
{
    try {
        output_stream stream(path, file);
        write_pixels(i, header_of(i, metadata, metadata_count), stream);
        return true;
    } catch (const std::bad_alloc &) {
        return report_error(r, "%s: does not fit into memory", path);
    } catch (const std::exception &problem) {
        return report_error(r, "%s: cannot be encoded: %s", path, problem.what());
    } catch (...) {
        return report_error(r, "%s: OpenEXR failed without saying why", path);
    }
}

void visit_texts(const Imf::Header &header, void (*visit)(const image_text *text, void *user), void *user)
{
    for (auto at = header.begin(); at != header.end(); ++at)
        if (const auto *text = dynamic_cast<const Imf::StringAttribute *>(&at.attribute())) {
            const image_text found = { at.name(), text->value().c_str() };
            visit(&found, user);
        }
}

/* Throws where the file ends too early: rows are written from the first to the last. */
void check_end(Imf::InputFile &file)
{
    const char *bytes = nullptr;
    int byte_count = 0;
    if (!file.isComplete())
        throw Iex::InputExc("rows are missing");
    if (!file.header().hasTileDescription())
        file.rawPixelData(file.header().dataWindow().max.y, bytes, byte_count);
}

} // namespace

bool image_exr_metadata(const char *path, void (*visit)(const image_text *text, void *user), void *user, report *r)
{
    try {
        Imf::InputFile file(path, 0);
        check_end(file);
        visit_texts(file.header(), visit, user);
        return true;
    } catch (const std::bad_alloc &) {
        return report_error(r, "%s: does not fit into memory", path);
    } catch (const std::exception &problem) {
        return report_error(r, "%s: is broken: %s", path, problem.what());
    } catch (...) {
        return report_error(r, "%s: OpenEXR failed without saying why", path);
    }
}

bool image_write_exr(const char *path, const image *i, const image_text *metadata, size_t metadata_count, report *r)
{
    output_file *file = image_check_names(i, path, r) ? output_file_open(path, r) : nullptr;
    if (!file)
        return false;
    if (encode(path, i, metadata, metadata_count, file, r))
        return output_file_commit(file, r);
    output_file_abort(file);
    return false;
}
