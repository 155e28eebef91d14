/* Every command: what --help, the manual pages and the completion of shells say of it. To add one, see command.h. */
#include "command/command_table.h"

#include "command/command.h"

/* clang-format off */
const Command command_table[] = {
    {"render", "SCENE", 1, 1, "Renders a scene to a PNG picture.", command_render,
     {{"rectray render scenes/cornell.json -o room.png", "the room, as its file says"},
      {"rectray render scenes/gallery.json --size 1920x1080 --grid 4", "larger, 16 rays a pixel, to gallery.png"}}},
    {"trace", "SCENE", 1, 1, "Tells step by step how a pixel gets its colour.", command_trace,
     {{"rectray trace scenes/cornell.json --pixel 320,240", "the middle of the room"},
      {"rectray trace scenes/gallery.json --mirror-depth 2 --summary", "a pixel seen through two mirrors, in short"}}},
    {"explore", "SCENE", 1, 1, "Writes a page: click a pixel, read how it came about.", command_explore,
     {{"rectray explore scenes/cornell.json -o room.html --open", "writes the page and shows it"},
      {"rectray explore house.json --pixel 320,240", "house.html, which begins with this pixel"}}},
    {"cast", "SCENE", 1, 1, "Intersects rays with a scene: lines `ox oy oz dx dy dz` in, CSV out.", command_cast,
     {{"echo 0 0 5 0 0 -1 | rectray cast scenes/original.json", "one ray, from standard input"},
      {"rectray cast scenes/cornell.json --rays rays.txt -b reference", "the rays of a file, in double"}}},
    {"check", "SCENE", 1, 1, "Validates a scene; tells what it holds, needs and can do without.", command_check,
     {{"rectray check house.json", "what is wrong with it, or what it holds"},
      {"rectray check house.json --geometry", "every face as it is traced"}}},
    {"compare", "A.png B.png", 2, 2, "Measures how far two pictures differ.", command_compare,
     {{"rectray compare mine.png theirs.png", "fails where any pixel differs"},
      {"rectray compare mine.png theirs.png --tolerance 1 --heatmap where.png", "forgives 1 of 255, draws the rest"}}},
    {"bench", "[HOW] SCENE...", 0, MAX_OPERANDS,
     "Measures speed; `error`: time against error; `kernels`: kernel by kernel.", command_bench,
     {{"rectray bench scenes/*.json", "the phases of each scene, medians of 5"},
      {"rectray bench kernels scenes/gallery.json --grid 1", "from the plain kernel to packets and tiles"}}},
    {"tree", "SCENE", 1, 1, "Shows the trees of a scene: their size, how they are built, their boxes.", command_tree,
     {{"rectray tree scenes/gallery.json", "nodes, depth and cost of the three trees"},
      {"rectray tree scenes/original.json --accel kdtree --step 3", "how the first three nodes were split"}}},
    {"generate", "KIND", 1, 1, "Writes a scene of a given size: menger, city or grid.", command_generate,
     {{"rectray generate menger --size 3 -o menger.json", "a sponge of three steps"},
      {"rectray generate city --size 1000 --seed 7 -o city.json", "a thousand boxes, another city for each seed"}}},
    {"devices", "[N]", 0, 1, "Lists the OpenCL devices, or device N; --check: does it work?", command_devices,
     {{"rectray devices", "the devices and their numbers"},
      {"rectray devices 0 --check", "whether device 0 compiles and renders rightly"}}},
    {"kernels", "", 0, 0, "Lists the kernel files inside the program; --export: writes them.", command_kernels,
     {{"rectray kernels", "their names"},
      {"rectray kernels --export mine", "writes them into the folder mine, to be changed"}}},
    {"help", "[COMMAND]", 0, 1, "Shows the help of the program or of a command.", command_help,
     {{"rectray help render", "the options of render"},
      {"rectray help render --as man | man -l -", "its manual page"}}},
    {0},
};
/* clang-format on */
