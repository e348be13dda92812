/* Plain files and folders, apart from the library under test. */
#include "files.h"

#include <assert.h>
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bytes file_read(const char *path)
{
    bytes b = { 0 };
    FILE *f = fopen(path, "rb");
    assert(f);
    size_t got;
    do {
        b.data = realloc(b.data, b.size + 4096);
        assert(b.data);
        got = fread(b.data + b.size, 1, 4096, f);
        b.size += got;
    } while (got > 0);
    fclose(f);
    return b;
}

void file_write(const char *path, const void *data, size_t size)
{
    FILE *f = fopen(path, "wb");
    assert(f);
    const size_t written = fwrite(data, 1, size, f);
    assert(written == size);
    (void)written;
    fclose(f);
}

char *folder_make(void)
{
    const char *parent = getenv("TMPDIR");
    char name[512];
    snprintf(name, sizeof name, "%s/glint-test-XXXXXX", parent ? parent : "/tmp");
    const char *made = mkdtemp(name);
    assert(made);
    return strdup(made);
}

static int visit(const char *folder, void (*act)(const char *path))
{
    DIR *d = opendir(folder);
    assert(d);
    int count = 0;
    for (const struct dirent *e = readdir(d); e; e = readdir(d)) {
        if (strcmp(e->d_name, ".") == 0 || strcmp(e->d_name, "..") == 0)
            continue;
        count++;
        if (act)
            act(folder_path(folder, e->d_name));
    }
    closedir(d);
    return count;
}

static void remove_file(const char *path)
{
    remove(path);
}

void folder_remove(char *folder)
{
    visit(folder, remove_file);
    rmdir(folder);
    free(folder);
}

int folder_count(const char *folder)
{
    return visit(folder, NULL);
}

const char *folder_path(const char *folder, const char *name)
{
    static char paths[4][1024];
    static int next;
    char *path = paths[next++ % 4];
    snprintf(path, sizeof paths[0], "%s/%s", folder, name);
    return path;
}
