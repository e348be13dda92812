/* Writes a file so that its name shows the old content or the whole of the new one, never a part. */
#ifndef IO_OUTPUT_FILE_H
#define IO_OUTPUT_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "scene/report.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct output_file output_file;

/* Opens a file under a temporary name in the folder of path. A link is followed; something that exists and is not a
 * regular file (a folder, a device) is an error, as is a folder that cannot be written. NULL after an error.
 *
 * The process must ignore SIGXFSZ where a limit on file sizes is to end in an error and not in a signal. */
output_file *output_file_open(const char *path, report *r);

/* Writes at the current position. After the first failure it writes nothing more, returns false, and the commit fails.
 */
bool output_file_write(output_file *f, const void *data, size_t byte_count);
/* Bytes from the start, for formats that fill in a table at the end. */
bool output_file_seek(output_file *f, int64_t position);
int64_t output_file_tell(output_file *f);

/* Puts the file on the disk and then under its name, with the permissions of the file that it replaces. On failure the
 * old file stays and the temporary one is gone. Frees f in any case. */
bool output_file_commit(output_file *f, report *r);
/* Removes the temporary file and frees f; NULL is allowed. */
void output_file_abort(output_file *f);

/* Whether path could be written now, found by trying: asked before long work, it saves the work. Leaves nothing behind.
 */
bool output_file_check(const char *path, report *r);

#ifdef __cplusplus
}
#endif

#endif
