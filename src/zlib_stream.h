/* A zlib stream (RFC 1950) that all processors make: it is cut into pieces, several are compressed at the same time, each
 * with the bytes before it for a dictionary, and their deflate blocks (RFC 1951) follow one another as if there were one
 * compressor. The method is pigz's (Mark Adler). The stream depends on its bytes and on the sizes that the caller
 * gives, never on the number of threads. Floor 1. */
#ifndef RECTRAY_ZLIB_STREAM_H
#define RECTRAY_ZLIB_STREAM_H

#include "error.h"

#include <stddef.h>

typedef struct ZlibStream ZlibStream;

/* Pieces of `piece` bytes, `pieces` of them held at a time, each but the first with the `history` bytes before it, at most
 * `piece` and 32768. `threads` as for parallel_threads. NULL, with the error filled, where the memory does not suffice. */
ZlibStream *zlib_stream_new(size_t piece, int pieces, size_t history, int threads, Error *error);

/* How many bytes can still be put before they must be compressed. */
size_t zlib_stream_room(const ZlibStream *stream);

/* Adds bytes to the stream, `count` of at most the room. */
void zlib_stream_put(ZlibStream *stream, const unsigned char *bytes, size_t count);

/* Compresses what was put and makes room. There must be none left, but with `last`, which ends the stream. The result is
 * in parts, to be written one after the other before anything else is put. */
void zlib_stream_compress(ZlibStream *stream, bool last);

/* Part i of what was compressed, and in `count` its bytes; NULL behind the last. */
const unsigned char *zlib_stream_part(const ZlibStream *stream, int i, size_t *count);

/* Frees the stream, which may be NULL. */
void zlib_stream_free(ZlibStream *stream);

#endif
