/* The sheet of an SVG drawing. */
#include "walkthrough/svg_view.h"

void svg_text(FILE *out, const char *text)
{
    for (; *text; text++)
        if (*text == '&' || *text == '<' || *text == '>' || *text == '\'' || *text == '"')
            fprintf(out, "&#%d;", *text);
        else
            fputc(*text, out);
}

void svg_sheet_begin(FILE *out, int width, int height, const char *title)
{
    fprintf(out, "<svg xmlns='http://www.w3.org/2000/svg' width='%d' height='%d' viewBox='0 0 %d %d'>\n<title>", width,
            height, width, height);
    svg_text(out, title);
    fprintf(out,
            "</title>\n<style>\ntext{font:13px 'DejaVu Sans',Verdana,sans-serif;fill:#333}\n"
            ".big{font-size:18px;font-weight:bold}.title{font-weight:bold}.tick{font-size:11px;fill:#777}\n"
            ".label{font-weight:bold;paint-order:stroke;stroke:#fff;stroke-width:3px;stroke-linejoin:round}\n"
            "path{fill:none}.paper{fill:#fff}.frame{fill:none;stroke:#999}.grid{stroke:#eee}\n"
            ".face{fill:#8899aa;fill-opacity:.07;stroke:#8899aa;stroke-opacity:.6}\n</style>\n"
            "<rect width='%d' height='%d' fill='#fafafa'/>\n",
            width, height);
}
