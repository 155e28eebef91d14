/* Pictures: what is written is read again, all or nothing appears under the name, and every kind of PNG is read. */
#define _XOPEN_SOURCE 700 /* mkdtemp */
#include "picture/image.h"

#include "unity.h"

#include <dirent.h>
#include <fcntl.h>
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static char folder[] = "/tmp/rectray-test-XXXXXX";
static char path[sizeof folder + 256]; /* a name has up to 255 bytes */
static Error error;
static Image image;

static const char *in_folder(const char *name)
{
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

void setUp(void)
{
    error = (Error){0};
    image = (Image){0};
    memcpy(folder + sizeof folder - 7, "XXXXXX", 6);
    TEST_ASSERT_NOT_NULL(mkdtemp(folder));
}

/* The number of files in the folder; removes them. */
static int empty_folder(void)
{
    int count = 0;
    DIR *directory = opendir(folder);
    for (struct dirent *entry; (entry = readdir(directory)) != NULL;)
        if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0)
            count += remove(in_folder(entry->d_name)) == 0;
    closedir(directory);
    return count;
}

void tearDown(void)
{
    image_free(&image);
    empty_folder();
    rmdir(folder);
}

/* 3 x 2 pixels, all bytes different. */
static const unsigned char PIXELS[18] = {0,   255, 1,   2,   3,   4,   100, 101, 102,
                                         103, 104, 105, 200, 201, 202, 203, 204, 205};

static void write_pixels(const char *name)
{
    Image picture = {3, 2, (unsigned char *)PIXELS};
    TEST_ASSERT_TRUE_MESSAGE(image_write(&picture, in_folder(name), &error), error.text);
}

static void put_text(const char *name, const char *text)
{
    FILE *file = fopen(in_folder(name), "wb");
    TEST_ASSERT_NOT_NULL(file);
    fputs(text, file);
    fclose(file);
}

static long file_bytes(const char *name, unsigned char *bytes, long room)
{
    FILE *file = fopen(in_folder(name), "rb");
    TEST_ASSERT_NOT_NULL(file);
    long count = (long)fread(bytes, 1, (size_t)room, file);
    fclose(file);
    return count;
}

static void image_should_be_read_as_it_was_written(void)
{
    write_pixels("a.png");
    TEST_ASSERT_TRUE_MESSAGE(image_read(&image, in_folder("a.png"), &error), error.text);
    TEST_ASSERT_EQUAL_INT(3, image.columns);
    TEST_ASSERT_EQUAL_INT(2, image.rows);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(PIXELS, image.rgb, 18);
}

static void image_should_not_depend_on_how_rows_are_grouped(void)
{
    unsigned char one[512], two[512];
    write_pixels("one.png");
    ImageWriter *writer = image_writer_open(in_folder("two.png"), 3, 2, &error);
    TEST_ASSERT_NOT_NULL(writer);
    TEST_ASSERT_TRUE(image_writer_rows(writer, PIXELS, 1, &error));
    TEST_ASSERT_TRUE(image_writer_rows(writer, PIXELS + 9, 1, &error));
    TEST_ASSERT_TRUE(image_writer_commit(writer, &error));
    long length = file_bytes("one.png", one, sizeof one);
    TEST_ASSERT_EQUAL_INT(length, file_bytes("two.png", two, sizeof two));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(one, two, length);
}

static void image_should_appear_only_when_it_is_complete(void)
{
    put_text("a.png", "old");
    ImageWriter *writer = image_writer_open(in_folder("a.png"), 3, 2, &error);
    TEST_ASSERT_NOT_NULL(writer);
    TEST_ASSERT_TRUE(image_writer_rows(writer, PIXELS, 1, &error));
    unsigned char bytes[8];
    TEST_ASSERT_EQUAL_INT(3, file_bytes("a.png", bytes, sizeof bytes));
    image_writer_abort(writer);
    TEST_ASSERT_EQUAL_INT(3, file_bytes("a.png", bytes, sizeof bytes));
    TEST_ASSERT_EQUAL_INT(1, empty_folder());
}

static void image_should_not_be_committed_with_rows_missing(void)
{
    ImageWriter *writer = image_writer_open(in_folder("a.png"), 3, 2, &error);
    TEST_ASSERT_NOT_NULL(writer);
    TEST_ASSERT_TRUE(image_writer_rows(writer, PIXELS, 1, &error));
    TEST_ASSERT_FALSE(image_writer_commit(writer, &error));
    TEST_ASSERT_EQUAL_INT(ERROR_SYSTEM, error.kind);
    TEST_ASSERT_EQUAL_INT(0, empty_folder());
}

static void image_should_have_the_mode_that_umask_gives(void)
{
    mode_t before = umask(027);
    write_pixels("a.png");
    umask(before);
    struct stat status;
    TEST_ASSERT_EQUAL_INT(0, stat(in_folder("a.png"), &status));
    TEST_ASSERT_EQUAL_HEX16(0640, status.st_mode & 0777);
}

static void image_should_follow_a_link_to_its_target(void)
{
    put_text("target.png", "old");
    char link[sizeof path];
    strcpy(link, in_folder("link.png"));
    TEST_ASSERT_EQUAL_INT(0, symlink("target.png", link));
    write_pixels("link.png");
    struct stat status;
    TEST_ASSERT_EQUAL_INT(0, lstat(link, &status));
    TEST_ASSERT_TRUE(S_ISLNK(status.st_mode));
    TEST_ASSERT_TRUE(image_read(&image, in_folder("target.png"), &error));
    TEST_ASSERT_EQUAL_INT(2, empty_folder());
}

static void image_writer_should_refuse_what_cannot_be_written(void)
{
    TEST_ASSERT_NULL(image_writer_open(folder, 3, 2, &error));
    TEST_ASSERT_EQUAL_INT(ERROR_SYSTEM, error.kind);
    TEST_ASSERT_NOT_NULL(strstr(error.text, "Is a directory"));
    error = (Error){0};
    TEST_ASSERT_NULL(image_writer_open(in_folder("missing/a.png"), 3, 2, &error));
    TEST_ASSERT_NOT_NULL(strstr(error.text, "missing/a.png: No such file or directory"));
    TEST_ASSERT_EQUAL_INT(0, empty_folder());
}

static void image_writer_should_tell_of_a_full_disk(void)
{
    Image picture = {3, 2, (unsigned char *)PIXELS};
    if (access("/dev/full", W_OK) != 0)
        TEST_IGNORE_MESSAGE("no /dev/full here");
    TEST_ASSERT_FALSE(image_write(&picture, "/dev/full", &error));
    TEST_ASSERT_EQUAL_STRING("cannot write /dev/full: No space left on device", error.text);
    TEST_ASSERT_EQUAL_INT(ERROR_SYSTEM, error.kind);
}

/* Writes a 3 x 2 picture of the given kind with libpng itself. Sample k of row r is 10 r + k + 1, of 16 bits also
 * in the low byte; a palette has the entries (i, 2 i, 3 i). */
static void write_kind(const char *name, int bits, int type, int interlace)
{
    FILE *file = fopen(in_folder(name), "wb");
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_set_IHDR(png, info, 3, 2, bits, type, interlace, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_color palette[32];
    for (int i = 0; i < 32; i++)
        palette[i] = (png_color){(png_byte)i, (png_byte)(2 * i), (png_byte)(3 * i)};
    if (type == PNG_COLOR_TYPE_PALETTE)
        png_set_PLTE(png, info, palette, 32);
    png_write_info(png, info);
    png_byte rows[2][24];
    png_bytep pointers[2] = {rows[0], rows[1]};
    for (int r = 0; r < 2; r++)
        for (int k = 0; k < 24; k++)
            rows[r][k] = (png_byte)(10 * r + (bits == 16 ? k / 2 : k) + 1);
    if (bits == 1)
        rows[0][0] = 0xA0, rows[1][0] = 0x40; /* 101, 010 */
    png_write_image(png, pointers);
    png_write_end(png, NULL);
    png_destroy_write_struct(&png, &info);
    fclose(file);
}

static void assert_read(const unsigned char expected[18])
{
    TEST_ASSERT_TRUE_MESSAGE(image_read(&image, path, &error), error.text);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, image.rgb, 18);
    image_free(&image);
}

static void image_read_should_take_every_kind_of_png(void)
{
    static const unsigned char rgb[18] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 11, 12, 13, 14, 15, 16, 17, 18, 19};
    static const unsigned char rgba[18] = {1, 2, 3, 5, 6, 7, 9, 10, 11, 11, 12, 13, 15, 16, 17, 19, 20, 21};
    static const unsigned char grey[18] = {1, 1, 1, 2, 2, 2, 3, 3, 3, 11, 11, 11, 12, 12, 12, 13, 13, 13};
    static const unsigned char grey_alpha[18] = {1, 1, 1, 3, 3, 3, 5, 5, 5, 11, 11, 11, 13, 13, 13, 15, 15, 15};
    static const unsigned char palette[18] = {1, 2, 3, 2, 4, 6, 3, 6, 9, 11, 22, 33, 12, 24, 36, 13, 26, 39};
    static const unsigned char bits[18] = {255, 255, 255, 0, 0, 0, 255, 255, 255, 0, 0, 0, 255, 255, 255, 0, 0, 0};
    for (int interlace = PNG_INTERLACE_NONE; interlace <= PNG_INTERLACE_ADAM7; interlace++) {
        write_kind("rgb.png", 8, PNG_COLOR_TYPE_RGB, interlace);
        assert_read(rgb);
        write_kind("rgb16.png", 16, PNG_COLOR_TYPE_RGB, interlace);
        assert_read(rgb);
        write_kind("rgba.png", 8, PNG_COLOR_TYPE_RGB_ALPHA, interlace);
        assert_read(rgba);
        write_kind("rgba16.png", 16, PNG_COLOR_TYPE_RGB_ALPHA, interlace);
        assert_read(rgba);
        write_kind("grey.png", 8, PNG_COLOR_TYPE_GRAY, interlace);
        assert_read(grey);
        write_kind("grey1.png", 1, PNG_COLOR_TYPE_GRAY, interlace);
        assert_read(bits);
        write_kind("greyalpha.png", 8, PNG_COLOR_TYPE_GRAY_ALPHA, interlace);
        assert_read(grey_alpha);
        write_kind("palette.png", 8, PNG_COLOR_TYPE_PALETTE, interlace);
        assert_read(palette);
    }
}

static void image_read_should_refuse_what_is_no_png(void)
{
    TEST_ASSERT_FALSE(image_read(&image, in_folder("missing.png"), &error));
    TEST_ASSERT_EQUAL_INT(ERROR_INPUT, error.kind);
    const char *const texts[] = {"", "GIF89a and more", "\x89PNG"};
    for (int i = 0; i < 3; i++) {
        error = (Error){0};
        put_text("a.png", texts[i]);
        TEST_ASSERT_FALSE(image_read(&image, in_folder("a.png"), &error));
        TEST_ASSERT_EQUAL_INT(ERROR_INPUT, error.kind);
        TEST_ASSERT_NOT_NULL(strstr(error.text, "a.png: neither a PNG nor a PPM picture"));
    }
    error = (Error){0};
    TEST_ASSERT_FALSE(image_read(&image, folder, &error));
    TEST_ASSERT_EQUAL_INT(ERROR_INPUT, error.kind);
}

static void image_read_should_refuse_a_picture_cut_anywhere(void)
{
    unsigned char bytes[512];
    write_pixels("a.png");
    long length = file_bytes("a.png", bytes, sizeof bytes);
    for (long cut = 0; cut < length; cut++) {
        FILE *file = fopen(in_folder("cut.png"), "wb");
        fwrite(bytes, 1, (size_t)cut, file);
        fclose(file);
        error = (Error){0};
        TEST_ASSERT_FALSE(image_read(&image, in_folder("cut.png"), &error));
        TEST_ASSERT_EQUAL_INT(ERROR_INPUT, error.kind);
        TEST_ASSERT_NULL(image.rgb);
    }
}

static void image_read_should_refuse_a_damaged_or_enormous_picture(void)
{
    unsigned char bytes[512];
    write_pixels("a.png");
    long length = file_bytes("a.png", bytes, sizeof bytes);
    for (long at = 8; at < length; at++) {
        bytes[at] ^= 0x10;
        FILE *file = fopen(in_folder("bad.png"), "wb");
        fwrite(bytes, 1, (size_t)length, file);
        fclose(file);
        bytes[at] ^= 0x10;
        error = (Error){0};
        if (image_read(&image, in_folder("bad.png"), &error)) /* a chunk that may be left out, by its letters */
            TEST_ASSERT_EQUAL_INT(3, image.columns);
        else
            TEST_ASSERT_EQUAL_INT(ERROR_INPUT, error.kind);
        image_free(&image);
    }
    error = (Error){0};
    ImageWriter *writer = image_writer_open(in_folder("wide.png"), IMAGE_MAX_SIDE + 1, 1, &error);
    unsigned char *row = calloc(IMAGE_MAX_SIDE + 1, 3);
    TEST_ASSERT_TRUE(writer && row && image_writer_rows(writer, row, 1, &error) && image_writer_commit(writer, &error));
    free(row);
    TEST_ASSERT_FALSE(image_read(&image, in_folder("wide.png"), &error));
    TEST_ASSERT_EQUAL_INT(ERROR_INPUT, error.kind);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(image_should_be_read_as_it_was_written);
    RUN_TEST(image_should_not_depend_on_how_rows_are_grouped);
    RUN_TEST(image_should_appear_only_when_it_is_complete);
    RUN_TEST(image_should_not_be_committed_with_rows_missing);
    RUN_TEST(image_should_have_the_mode_that_umask_gives);
    RUN_TEST(image_should_follow_a_link_to_its_target);
    RUN_TEST(image_writer_should_refuse_what_cannot_be_written);
    RUN_TEST(image_writer_should_tell_of_a_full_disk);
    RUN_TEST(image_read_should_take_every_kind_of_png);
    RUN_TEST(image_read_should_refuse_what_is_no_png);
    RUN_TEST(image_read_should_refuse_a_picture_cut_anywhere);
    RUN_TEST(image_read_should_refuse_a_damaged_or_enormous_picture);
    return UNITY_END();
}
