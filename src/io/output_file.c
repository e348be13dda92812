/* A file is written under a temporary name beside its own, put on the disk, and renamed: rename replaces in one step.
 */
#include "io/output_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

struct output_file {
    char *path;      /* links resolved */
    char *temporary; /* in the same folder, so that rename never crosses file systems */
    FILE *stream;
    int error; /* errno of the first failure; 0 while there is none */
};

static void output_file_free(output_file *f)
{
    if (!f)
        return;
    free(f->path);
    free(f->temporary);
    free(f);
}

static bool remember(output_file *f, bool done)
{
    if (!done && !f->error)
        f->error = errno ? errno : EIO;
    return f->error == 0;
}

/* Where the bytes end up: a link that leads somewhere is followed. NULL without memory. */
static char *resolve(const char *path)
{
    char *target = realpath(path, NULL);
    return target || errno == ENOMEM ? target : strdup(path);
}

/* The name of the temporary file does not grow with that of the file, which may have the greatest length there is. */
static char *temporary_name(const char *path, unsigned number)
{
    const char *slash = strrchr(path, '/');
    const size_t folder_length = slash ? (size_t)(slash - path) + 1 : 0;
    const size_t size = folder_length + 64;
    char *name = malloc(size);
    if (!name)
        return NULL;
    memcpy(name, path, folder_length);
    snprintf(name + folder_length, size - folder_length, ".glint-%ld-%u.part", (long)getpid(), number);
    return name;
}

/* open and not mkstemp, because the file is to get the permissions that the user's umask gives to any new file. */
static int create_temporary(output_file *f)
{
    static atomic_uint counter;
    int descriptor;
    do {
        free(f->temporary);
        f->temporary = temporary_name(f->path, atomic_fetch_add(&counter, 1));
        if (!f->temporary)
            return -1;
        descriptor = open(f->temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (descriptor < 0 && errno == EEXIST);
    return descriptor;
}

/* Something there that rename would destroy or refuse, found before the work and not after it. */
static bool may_replace(const char *path, mode_t *mode, report *r)
{
    const size_t length = strlen(path);
    if (length == 0 || path[length - 1] == '/')
        return report_error(r, "%s: cannot be written: expected the name of a file", path);
    struct stat existing;
    if (stat(path, &existing) != 0) {
        if (errno == ENOENT)
            return true;
        return report_error(r, "%s: cannot be written: %s", path, strerror(errno));
    }
    if (S_ISDIR(existing.st_mode))
        return report_error(r, "%s: cannot be written: it is a folder, expected the name of a file", path);
    if (!S_ISREG(existing.st_mode))
        return report_error(r, "%s: cannot be written: it is a device or a pipe, expected a regular file", path);
    *mode = existing.st_mode & 07777;
    return true;
}

static bool open_stream(output_file *f, mode_t mode)
{
    const int descriptor = create_temporary(f);
    if (descriptor < 0)
        return false;
    if (mode != 0 && fchmod(descriptor, mode) != 0) {
        const int reason = errno;
        close(descriptor);
        unlink(f->temporary);
        errno = reason;
        return false;
    }
    f->stream = fdopen(descriptor, "wb");
    if (!f->stream) {
        close(descriptor);
        unlink(f->temporary);
        errno = ENOMEM;
    }
    return f->stream != NULL;
}

output_file *output_file_open(const char *path, report *r)
{
    mode_t mode = 0;
    if (!may_replace(path, &mode, r))
        return NULL;
    output_file *f = calloc(1, sizeof *f);
    if (f)
        f->path = resolve(path);
    if (!f || !f->path) {
        report_error(r, "%s: cannot be written: %s", path, strerror(ENOMEM));
    } else if (!open_stream(f, mode)) {
        report_error(r, "%s: cannot be written: no new file in its folder: %s", path, strerror(errno));
    } else {
        return f;
    }
    output_file_free(f);
    return NULL;
}

bool output_file_write(output_file *f, const void *data, size_t byte_count)
{
    return !f->error && remember(f, fwrite(data, 1, byte_count, f->stream) == byte_count);
}

bool output_file_seek(output_file *f, int64_t position)
{
    return !f->error && remember(f, fseeko(f->stream, position, SEEK_SET) == 0);
}

int64_t output_file_tell(output_file *f)
{
    return ftello(f->stream);
}

bool output_file_commit(output_file *f, report *r)
{
    if (!f->error && remember(f, fflush(f->stream) == 0))
        remember(f, fsync(fileno(f->stream)) == 0);
    const bool closed = fclose(f->stream) == 0;
    if (!remember(f, closed) || !remember(f, rename(f->temporary, f->path) == 0)) {
        unlink(f->temporary);
        report_error(r, "%s: cannot be written: %s", f->path, strerror(f->error));
    }
    const bool done = f->error == 0;
    output_file_free(f);
    return done;
}

void output_file_abort(output_file *f)
{
    if (!f)
        return;
    fclose(f->stream);
    unlink(f->temporary);
    output_file_free(f);
}

bool output_file_check(const char *path, report *r)
{
    output_file *f = output_file_open(path, r);
    output_file_abort(f);
    return f != NULL;
}
