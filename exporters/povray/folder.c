/* All files of a folder, or none: they are written beside their names first and renamed when the last one is whole. */
#include "exporters/povray/folder.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool folder_open(folder *f, const char *path, report *r)
{
    *f = (folder){ .path = path };
    struct stat there;
    if (mkdir(path, 0777) == 0) {
        f->made = true;
        return true;
    }
    if (errno != EEXIST)
        return report_error(r, "%s: the folder cannot be made: %s", path, strerror(errno));
    if (stat(path, &there) != 0)
        return report_error(r, "%s: cannot be written to: %s", path, strerror(errno));
    if (!S_ISDIR(there.st_mode))
        return report_error(r, "%s: cannot be written to: it is a file, expected a folder", path);
    return true;
}

static folder_file *append(folder *f, const char *name)
{
    folder_file *files = realloc(f->files, ((size_t)f->count + 1) * sizeof *files);
    if (!files)
        return NULL;
    f->files = files;
    const size_t size = strlen(f->path) + strlen(name) + 2;
    char *path = malloc(size);
    if (!path)
        return NULL;
    snprintf(path, size, "%s/%s", f->path, name);
    files[f->count] = (folder_file){ .path = path };
    return &files[f->count++];
}

bool folder_write(folder *f, const char *name, const void *bytes, size_t count, report *r)
{
    folder_file *to = append(f, name);
    if (!to)
        return report_error(r, "%s/%s: out of memory", f->path, name);
    to->file = output_file_open(to->path, r);
    if (!to->file)
        return false;
    errno = 0;
    if (count > 0 && !output_file_write(to->file, bytes, count))
        return report_error(r, "%s: cannot be written: %s", to->path, strerror(errno ? errno : EIO));
    return true;
}

bool folder_commit(folder *f, report *r)
{
    for (int i = 0; i < f->count; ++i) {
        output_file *file = f->files[i].file;
        f->files[i].file = NULL;
        if (!output_file_commit(file, r))
            return false;
        f->made = false;
    }
    return true;
}

void folder_close(folder *f)
{
    for (int i = 0; i < f->count; ++i) {
        output_file_abort(f->files[i].file);
        free(f->files[i].path);
    }
    free(f->files);
    if (f->made)
        rmdir(f->path);
    *f = (folder){ 0 };
}
