/* Pictures of every size, however their rows come, are one and the same file, and a reader that takes a warning for an
 * error finds the pixels in it. */
#define _XOPEN_SOURCE 700 /* mkdtemp */
#include "picture/image.h"

#include "unity.h"

#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char folder[] = "/tmp/rectray-test-XXXXXX";
static char path[sizeof folder + 16];
static Error error;
static Image image;

void setUp(void)
{
    error = (Error){0};
    image = (Image){0};
    memcpy(folder + sizeof folder - 7, "XXXXXX", 6);
    TEST_ASSERT_NOT_NULL(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/a.png", folder);
}

void tearDown(void)
{
    image_free(&image);
    remove(path);
    rmdir(folder);
}

/* Flat faces, a gradient, and noise that no compressor makes smaller. */
static void make_picture(int columns, int rows)
{
    image_free(&image);
    image = (Image){columns, rows, malloc((size_t)columns * (size_t)rows * 3)};
    TEST_ASSERT_NOT_NULL(image.rgb);
    unsigned noise = 1;
    for (int row = 0; row < rows; row++)
        for (int i = 0; i < 3 * columns; i++) {
            noise = noise * 1664525 + 1013904223;
            int kind = (row / 50 + i / 700) % 3;
            image.rgb[(size_t)row * (size_t)columns * 3 + (size_t)i] =
                (unsigned char)(kind == 0   ? 40 * (i % 3)
                                : kind == 1 ? row + i / 3
                                            : (int)(noise >> 24));
        }
}

/* Writes the picture, `step` rows at a time. */
static void write_picture(int step)
{
    ImageWriter *writer = image_writer_open(path, image.columns, image.rows, &error);
    TEST_ASSERT_NOT_NULL(writer);
    for (int row = 0; row < image.rows; row += step) {
        int rows = image.rows - row < step ? image.rows - row : step;
        TEST_ASSERT_TRUE(image_writer_rows(writer, image.rgb + (size_t)row * (size_t)image.columns * 3, rows, &error));
    }
    TEST_ASSERT_TRUE_MESSAGE(image_writer_commit(writer, &error), error.text);
}

static void fail(png_structp png, png_const_charp message)
{
    (void)png;
    TEST_FAIL_MESSAGE(message);
}

static void assert_picture_is_read(void)
{
    FILE *file = fopen(path, "rb");
    TEST_ASSERT_NOT_NULL(file);
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, NULL, fail, fail);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_read_info(png, info);
    TEST_ASSERT_EQUAL_INT(image.columns, png_get_image_width(png, info));
    TEST_ASSERT_EQUAL_INT(image.rows, png_get_image_height(png, info));
    TEST_ASSERT_EQUAL_INT(PNG_COLOR_TYPE_RGB, png_get_color_type(png, info));
    size_t bytes = (size_t)image.columns * 3;
    unsigned char *row = malloc(bytes);
    TEST_ASSERT_NOT_NULL(row);
    for (int i = 0; i < image.rows; i++) {
        png_read_row(png, row, NULL);
        TEST_ASSERT_EQUAL_INT(0, memcmp(image.rgb + (size_t)i * bytes, row, bytes));
    }
    png_read_end(png, info);
    TEST_ASSERT_EQUAL_INT(EOF, fgetc(file));
    free(row);
    png_destroy_read_struct(&png, &info, NULL);
    fclose(file);
}

/* The file's bytes; the caller frees them. */
static unsigned char *file_bytes(long *length)
{
    FILE *file = fopen(path, "rb");
    TEST_ASSERT_NOT_NULL(file);
    fseek(file, 0, SEEK_END);
    *length = ftell(file);
    rewind(file);
    unsigned char *bytes = malloc((size_t)*length);
    TEST_ASSERT_NOT_NULL(bytes);
    TEST_ASSERT_EQUAL_INT(*length, fread(bytes, 1, (size_t)*length, file));
    fclose(file);
    return bytes;
}

static void check_size(int columns, int rows)
{
    make_picture(columns, rows);
    write_picture(rows);
    assert_picture_is_read();
}

static void picture_of_few_pixels_should_be_read_again(void)
{
    for (int columns = 1; columns <= 5; columns++)
        for (int rows = 1; rows <= 5; rows++)
            check_size(columns, rows);
}

static void picture_of_one_row_or_column_should_be_read_again(void)
{
    check_size(IMAGE_MAX_SIDE, 1);
    check_size(1, IMAGE_MAX_SIDE);
    check_size(2001, 1);
    check_size(1, 2001);
}

/* Of a picture 1365 wide 64 rows of 4096 bytes, 256 KiB, are compressed at a time. */
static void picture_should_be_read_again_where_rows_are_compressed(void)
{
    for (int times = 1; times <= 12; times++)
        for (int more = -1; more <= 1; more++)
            check_size(1365, 64 * times + more);
}

static void picture_of_the_widest_rows_should_be_read_again(void)
{
    check_size(IMAGE_MAX_SIDE, 3);
    check_size(IMAGE_MAX_SIDE, 4);
    check_size(IMAGE_MAX_SIDE, 100);
}

static void file_should_not_depend_on_how_rows_come(void)
{
    static const int steps[] = {1, 7, 64, 65, 999};
    long length, other;
    make_picture(1365, 1000);
    write_picture(1000);
    unsigned char *bytes = file_bytes(&length);
    for (int i = 0; i < 5; i++) {
        write_picture(steps[i]);
        unsigned char *again = file_bytes(&other);
        TEST_ASSERT_EQUAL_INT(length, other);
        TEST_ASSERT_EQUAL_INT(0, memcmp(bytes, again, (size_t)length));
        free(again);
    }
    free(bytes);
}

/* A flat picture of 5x4 pixels is compressed at 512 addresses, 64 KiB apart: all values of an address's third byte. */
static void file_should_not_depend_on_where_memory_lies(void)
{
    enum { TIMES = 512, APART = 64 * 1024 };
    static void *held[TIMES];
    long length, other;
    make_picture(5, 4);
    memset(image.rgb, 128, 5 * 4 * 3);
    memset(image.rgb + 18, 0, 6);
    write_picture(4);
    unsigned char *bytes = file_bytes(&length);
    int differ = 0;
    for (int i = 0; i < TIMES; i++) {
        held[i] = malloc(APART);
        write_picture(4);
        unsigned char *again = file_bytes(&other);
        differ += other != length || memcmp(bytes, again, (size_t)length) != 0;
        free(again);
    }
    for (int i = 0; i < TIMES; i++)
        free(held[i]);
    free(bytes);
    TEST_ASSERT_EQUAL_INT(0, differ);
}

static void writer_should_be_left_halfway(void)
{
    make_picture(1365, 1000);
    ImageWriter *writer = image_writer_open(path, 1365, 1000, &error);
    TEST_ASSERT_NOT_NULL(writer);
    TEST_ASSERT_TRUE(image_writer_rows(writer, image.rgb, 900, &error));
    TEST_ASSERT_FALSE(image_writer_commit(writer, &error));
    TEST_ASSERT_EQUAL_INT(ERROR_SYSTEM, error.kind);
    TEST_ASSERT_NOT_NULL(strstr(error.text, "rows are missing"));
    TEST_ASSERT_EQUAL_INT(-1, access(path, F_OK));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(picture_of_few_pixels_should_be_read_again);
    RUN_TEST(picture_of_one_row_or_column_should_be_read_again);
    RUN_TEST(picture_should_be_read_again_where_rows_are_compressed);
    RUN_TEST(picture_of_the_widest_rows_should_be_read_again);
    RUN_TEST(file_should_not_depend_on_how_rows_come);
    RUN_TEST(file_should_not_depend_on_where_memory_lies);
    RUN_TEST(writer_should_be_left_halfway);
    return UNITY_END();
}
