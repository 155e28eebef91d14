/* Files of text in blocks of whole lines. */
#include "base/text_blocks.h"

#include "base/text.h"

#include <stdlib.h>
#include <string.h>

bool text_blocks_open(TextBlocks *blocks, const char *path, Error *error)
{
    *blocks = (TextBlocks){.path = path};
    blocks->buffer = malloc(TEXT_BLOCK_MAX + 2); /* two ends of a line, or a NUL */
    if (!blocks->buffer)
        return error_memory(error, path);
    blocks->rest = blocks->buffer;
    blocks->file = text_open(path, error);
    return blocks->file != NULL;
}

/* Moves the rest to the front and fills the buffer up. */
static bool fill(TextBlocks *blocks, Error *error)
{
    memmove(blocks->buffer, blocks->rest, (size_t)blocks->rest_length);
    blocks->rest = blocks->buffer;
    size_t room = (size_t)(TEXT_BLOCK_MAX - blocks->rest_length);
    size_t got = fread(blocks->buffer + blocks->rest_length, 1, room, blocks->file);
    blocks->rest_length += (long)got;
    blocks->ended = got < room;
    if (ferror(blocks->file))
        return text_fail_errno(blocks->path, "cannot be read", error);
    return true;
}

/* Looks at the beginning of the file. */
static bool begin(TextBlocks *blocks, Error *error)
{
    blocks->begun = true;
    blocks->buffer[blocks->rest_length] = '\0';
    if (text_is_utf16(blocks->buffer))
        return error_set(error, ERROR_INPUT, "%s:1: is UTF-16; save it as UTF-8", blocks->path);
    if (strncmp(blocks->buffer, "\xEF\xBB\xBF", 3) == 0) {
        blocks->rest += 3;
        blocks->rest_length -= 3;
    }
    return true;
}

static bool fail_nul(const TextBlocks *blocks, const char *nul, Error *error)
{
    long line = blocks->line + 1;
    for (const char *c = blocks->rest; c < nul; c++)
        line += *c == '\n';
    return error_set(error, ERROR_INPUT, "%s:%ld: a NUL byte; this is not a text file", blocks->path, line);
}

/* Gives new bytes the ends of lines that the reader sees. A backslash before CR LF stays before the '\n'. */
static bool clean(TextBlocks *blocks, Error *error)
{
    char *end = blocks->rest + blocks->rest_length, *at = blocks->rest + blocks->clean_length;
    const char *nul = memchr(at, '\0', (size_t)(end - at));
    while (at < end && (at = memchr(at, '\r', (size_t)(end - at)))) {
        if (at + 1 == end && !blocks->ended)
            break; /* the next byte decides */
        bool pair = at + 1 < end && at[1] == '\n', continued = pair && at > blocks->rest && at[-1] == '\\';
        if (continued)
            at[-1] = ' ';
        *at = !pair ? '\n' : continued ? '\\' : ' ';
        at++;
    }
    blocks->clean_length = (at ? at : end) - blocks->rest;
    return !nul || fail_nul(blocks, nul, error);
}

/* The end of the last line that no other continues; NULL where there is none. */
static char *last_line_end(const TextBlocks *blocks)
{
    for (char *end = blocks->rest + blocks->rest_length; end > blocks->rest; end--)
        if (end[-1] == '\n' && (end - 1 == blocks->rest || end[-2] != '\\'))
            return end;
    return NULL;
}

/* All that is left, with the end of a line. */
static TextBlock last_block(TextBlocks *blocks)
{
    TextBlock block = {blocks->rest, blocks->rest + blocks->rest_length};
    if (blocks->rest_length == 0)
        return (TextBlock){NULL, NULL};
    if (block.end[-1] != '\n')
        *block.end++ = '\n';
    if (block.end - block.at > 1 && block.end[-2] == '\\') /* nothing continues it */
        *block.end++ = '\n';
    blocks->rest_length = 0;
    return block;
}

TextBlock text_blocks_next(TextBlocks *blocks, Error *error)
{
    static const TextBlock none = {NULL, NULL};
    if (blocks->ended)
        return none;
    if (!fill(blocks, error) || (!blocks->begun && !begin(blocks, error)) || !clean(blocks, error))
        return none;
    if (blocks->ended)
        return last_block(blocks);
    TextBlock block = {blocks->rest, last_line_end(blocks)};
    if (!block.end) {
        error_set(
            error, ERROR_INPUT,
            "%s:%ld: the line is longer than %d bytes, with the lines that continue it; make several lines of it, or "
            "leave it out if it is a comment",
            blocks->path, blocks->line + 1, TEXT_BLOCK_MAX);
        return none;
    }
    blocks->rest = block.end;
    blocks->rest_length -= block.end - block.at;
    blocks->clean_length -= block.end - block.at;
    return block;
}

void text_blocks_close(TextBlocks *blocks)
{
    if (blocks->file)
        fclose(blocks->file);
    free(blocks->buffer);
    *blocks = (TextBlocks){0};
}
