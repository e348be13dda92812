/* The previewer's part of the digest, where there is a previewer. */
#ifndef TESTS_DIGEST_PREVIEW_H
#define TESTS_DIGEST_PREVIEW_H

void digest_print_preview(void);

#endif
