/// Names in the drawing's code page become UTF-8, so that they can be typed, shown and compared.
///
/// Before release 2007 (AC1021) a drawing's texts are in the code page that its header names; later
/// they are UTF-8. Pages of one byte a character for Windows are tables here. All other pages are
/// those of libxml2, which may have been built without them. Characters that cannot be read become
/// the escapes that such drawings themselves may have: \M+1xxxx is a character of two bytes, where
/// 1 to 5 stands for the page 932, 950, 949, 1361 or 936 (\M+0: any). \U+xxxx is one of Unicode.
///
/// Programs write UTF-8 in older drawings, too. Texts that are UTF-8 throughout are hardly ever
/// anything else in a page of one byte. In pages of two bytes, for Asia, this holds where each
/// character has three bytes or more, as those of Asia have.
#include "io/dxf/dxf.h"

#include <libxml/encoding.h>
#include <libxml/xmlerror.h>
#include <stdio.h>
#include <stdlib.h>

// --- code pages

/// The upper halves of the pages 1250 to 1258, in UTF-16; U+FFFD where there is nothing.
// clang-format off
static const uint16_t windows[9][128] = {
    {0x20ac, 0xfffd, 0x201a, 0xfffd, 0x201e, 0x2026, 0x2020, 0x2021, 0xfffd, 0x2030, 0x0160, 0x2039,
     0x015a, 0x0164, 0x017d, 0x0179, 0xfffd, 0x2018, 0x2019, 0x201c, 0x201d, 0x2022, 0x2013, 0x2014,
     0xfffd, 0x2122, 0x0161, 0x203a, 0x015b, 0x0165, 0x017e, 0x017a, 0x00a0, 0x02c7, 0x02d8, 0x0141,
     0x00a4, 0x0104, 0x00a6, 0x00a7, 0x00a8, 0x00a9, 0x015e, 0x00ab, 0x00ac, 0x00ad, 0x00ae, 0x017b,
     0x00b0, 0x00b1, 0x02db, 0x0142, 0x00b4, 0x00b5, 0x00b6, 0x00b7, 0x00b8, 0x0105, 0x015f, 0x00bb,
     0x013d, 0x02dd, 0x013e, 0x017c, 0x0154, 0x00c1, 0x00c2, 0x0102, 0x00c4, 0x0139, 0x0106, 0x00c7,
     0x010c, 0x00c9, 0x0118, 0x00cb, 0x011a, 0x00cd, 0x00ce, 0x010e, 0x0110, 0x0143, 0x0147, 0x00d3,
     0x00d4, 0x0150, 0x00d6, 0x00d7, 0x0158, 0x016e, 0x00da, 0x0170, 0x00dc, 0x00dd, 0x0162, 0x00df,
     0x0155, 0x00e1, 0x00e2, 0x0103, 0x00e4, 0x013a, 0x0107, 0x00e7, 0x010d, 0x00e9, 0x0119, 0x00eb,
     0x011b, 0x00ed, 0x00ee, 0x010f, 0x0111, 0x0144, 0x0148, 0x00f3, 0x00f4, 0x0151, 0x00f6, 0x00f7,
     0x0159, 0x016f, 0x00fa, 0x0171, 0x00fc, 0x00fd, 0x0163, 0x02d9},
    {0x0402, 0x0403, 0x201a, 0x0453, 0x201e, 0x2026, 0x2020, 0x2021, 0x20ac, 0x2030, 0x0409, 0x2039,
     0x040a, 0x040c, 0x040b, 0x040f, 0x0452, 0x2018, 0x2019, 0x201c, 0x201d, 0x2022, 0x2013, 0x2014,
     0xfffd, 0x2122, 0x0459, 0x203a, 0x045a, 0x045c, 0x045b, 0x045f, 0x00a0, 0x040e, 0x045e, 0x0408,
     0x00a4, 0x0490, 0x00a6, 0x00a7, 0x0401, 0x00a9, 0x0404, 0x00ab, 0x00ac, 0x00ad, 0x00ae, 0x0407,
     0x00b0, 0x00b1, 0x0406, 0x0456, 0x0491, 0x00b5, 0x00b6, 0x00b7, 0x0451, 0x2116, 0x0454, 0x00bb,
     0x0458, 0x0405, 0x0455, 0x0457, 0x0410, 0x0411, 0x0412, 0x0413, 0x0414, 0x0415, 0x0416, 0x0417,
     0x0418, 0x0419, 0x041a, 0x041b, 0x041c, 0x041d, 0x041e, 0x041f, 0x0420, 0x0421, 0x0422, 0x0423,
     0x0424, 0x0425, 0x0426, 0x0427, 0x0428, 0x0429, 0x042a, 0x042b, 0x042c, 0x042d, 0x042e, 0x042f,
     0x0430, 0x0431, 0x0432, 0x0433, 0x0434, 0x0435, 0x0436, 0x0437, 0x0438, 0x0439, 0x043a, 0x043b,
     0x043c, 0x043d, 0x043e, 0x043f, 0x0440, 0x0441, 0x0442, 0x0443, 0x0444, 0x0445, 0x0446, 0x0447,
     0x0448, 0x0449, 0x044a, 0x044b, 0x044c, 0x044d, 0x044e, 0x044f},
    {0x20ac, 0xfffd, 0x201a, 0x0192, 0x201e, 0x2026, 0x2020, 0x2021, 0x02c6, 0x2030, 0x0160, 0x2039,
     0x0152, 0xfffd, 0x017d, 0xfffd, 0xfffd, 0x2018, 0x2019, 0x201c, 0x201d, 0x2022, 0x2013, 0x2014,
     0x02dc, 0x2122, 0x0161, 0x203a, 0x0153, 0xfffd, 0x017e, 0x0178, 0x00a0, 0x00a1, 0x00a2, 0x00a3,
     0x00a4, 0x00a5, 0x00a6, 0x00a7, 0x00a8, 0x00a9, 0x00aa, 0x00ab, 0x00ac, 0x00ad, 0x00ae, 0x00af,
     0x00b0, 0x00b1, 0x00b2, 0x00b3, 0x00b4, 0x00b5, 0x00b6, 0x00b7, 0x00b8, 0x00b9, 0x00ba, 0x00bb,
     0x00bc, 0x00bd, 0x00be, 0x00bf, 0x00c0, 0x00c1, 0x00c2, 0x00c3, 0x00c4, 0x00c5, 0x00c6, 0x00c7,
     0x00c8, 0x00c9, 0x00ca, 0x00cb, 0x00cc, 0x00cd, 0x00ce, 0x00cf, 0x00d0, 0x00d1, 0x00d2, 0x00d3,
     0x00d4, 0x00d5, 0x00d6, 0x00d7, 0x00d8, 0x00d9, 0x00da, 0x00db, 0x00dc, 0x00dd, 0x00de, 0x00df,
     0x00e0, 0x00e1, 0x00e2, 0x00e3, 0x00e4, 0x00e5, 0x00e6, 0x00e7, 0x00e8, 0x00e9, 0x00ea, 0x00eb,
     0x00ec, 0x00ed, 0x00ee, 0x00ef, 0x00f0, 0x00f1, 0x00f2, 0x00f3, 0x00f4, 0x00f5, 0x00f6, 0x00f7,
     0x00f8, 0x00f9, 0x00fa, 0x00fb, 0x00fc, 0x00fd, 0x00fe, 0x00ff},
    {0x20ac, 0xfffd, 0x201a, 0x0192, 0x201e, 0x2026, 0x2020, 0x2021, 0xfffd, 0x2030, 0xfffd, 0x2039,
     0xfffd, 0xfffd, 0xfffd, 0xfffd, 0xfffd, 0x2018, 0x2019, 0x201c, 0x201d, 0x2022, 0x2013, 0x2014,
     0xfffd, 0x2122, 0xfffd, 0x203a, 0xfffd, 0xfffd, 0xfffd, 0xfffd, 0x00a0, 0x0385, 0x0386, 0x00a3,
     0x00a4, 0x00a5, 0x00a6, 0x00a7, 0x00a8, 0x00a9, 0xfffd, 0x00ab, 0x00ac, 0x00ad, 0x00ae, 0x2015,
     0x00b0, 0x00b1, 0x00b2, 0x00b3, 0x0384, 0x00b5, 0x00b6, 0x00b7, 0x0388, 0x0389, 0x038a, 0x00bb,
     0x038c, 0x00bd, 0x038e, 0x038f, 0x0390, 0x0391, 0x0392, 0x0393, 0x0394, 0x0395, 0x0396, 0x0397,
     0x0398, 0x0399, 0x039a, 0x039b, 0x039c, 0x039d, 0x039e, 0x039f, 0x03a0, 0x03a1, 0xfffd, 0x03a3,
     0x03a4, 0x03a5, 0x03a6, 0x03a7, 0x03a8, 0x03a9, 0x03aa, 0x03ab, 0x03ac, 0x03ad, 0x03ae, 0x03af,
     0x03b0, 0x03b1, 0x03b2, 0x03b3, 0x03b4, 0x03b5, 0x03b6, 0x03b7, 0x03b8, 0x03b9, 0x03ba, 0x03bb,
     0x03bc, 0x03bd, 0x03be, 0x03bf, 0x03c0, 0x03c1, 0x03c2, 0x03c3, 0x03c4, 0x03c5, 0x03c6, 0x03c7,
     0x03c8, 0x03c9, 0x03ca, 0x03cb, 0x03cc, 0x03cd, 0x03ce, 0xfffd},
    {0x20ac, 0xfffd, 0x201a, 0x0192, 0x201e, 0x2026, 0x2020, 0x2021, 0x02c6, 0x2030, 0x0160, 0x2039,
     0x0152, 0xfffd, 0xfffd, 0xfffd, 0xfffd, 0x2018, 0x2019, 0x201c, 0x201d, 0x2022, 0x2013, 0x2014,
     0x02dc, 0x2122, 0x0161, 0x203a, 0x0153, 0xfffd, 0xfffd, 0x0178, 0x00a0, 0x00a1, 0x00a2, 0x00a3,
     0x00a4, 0x00a5, 0x00a6, 0x00a7, 0x00a8, 0x00a9, 0x00aa, 0x00ab, 0x00ac, 0x00ad, 0x00ae, 0x00af,
     0x00b0, 0x00b1, 0x00b2, 0x00b3, 0x00b4, 0x00b5, 0x00b6, 0x00b7, 0x00b8, 0x00b9, 0x00ba, 0x00bb,
     0x00bc, 0x00bd, 0x00be, 0x00bf, 0x00c0, 0x00c1, 0x00c2, 0x00c3, 0x00c4, 0x00c5, 0x00c6, 0x00c7,
     0x00c8, 0x00c9, 0x00ca, 0x00cb, 0x00cc, 0x00cd, 0x00ce, 0x00cf, 0x011e, 0x00d1, 0x00d2, 0x00d3,
     0x00d4, 0x00d5, 0x00d6, 0x00d7, 0x00d8, 0x00d9, 0x00da, 0x00db, 0x00dc, 0x0130, 0x015e, 0x00df,
     0x00e0, 0x00e1, 0x00e2, 0x00e3, 0x00e4, 0x00e5, 0x00e6, 0x00e7, 0x00e8, 0x00e9, 0x00ea, 0x00eb,
     0x00ec, 0x00ed, 0x00ee, 0x00ef, 0x011f, 0x00f1, 0x00f2, 0x00f3, 0x00f4, 0x00f5, 0x00f6, 0x00f7,
     0x00f8, 0x00f9, 0x00fa, 0x00fb, 0x00fc, 0x0131, 0x015f, 0x00ff},
    {0x20ac, 0xfffd, 0x201a, 0x0192, 0x201e, 0x2026, 0x2020, 0x2021, 0x02c6, 0x2030, 0xfffd, 0x2039,
     0xfffd, 0xfffd, 0xfffd, 0xfffd, 0xfffd, 0x2018, 0x2019, 0x201c, 0x201d, 0x2022, 0x2013, 0x2014,
     0x02dc, 0x2122, 0xfffd, 0x203a, 0xfffd, 0xfffd, 0xfffd, 0xfffd, 0x00a0, 0x00a1, 0x00a2, 0x00a3,
     0x20aa, 0x00a5, 0x00a6, 0x00a7, 0x00a8, 0x00a9, 0x00d7, 0x00ab, 0x00ac, 0x00ad, 0x00ae, 0x00af,
     0x00b0, 0x00b1, 0x00b2, 0x00b3, 0x00b4, 0x00b5, 0x00b6, 0x00b7, 0x00b8, 0x00b9, 0x00f7, 0x00bb,
     0x00bc, 0x00bd, 0x00be, 0x00bf, 0x05b0, 0x05b1, 0x05b2, 0x05b3, 0x05b4, 0x05b5, 0x05b6, 0x05b7,
     0x05b8, 0x05b9, 0xfffd, 0x05bb, 0x05bc, 0x05bd, 0x05be, 0x05bf, 0x05c0, 0x05c1, 0x05c2, 0x05c3,
     0x05f0, 0x05f1, 0x05f2, 0x05f3, 0x05f4, 0xfffd, 0xfffd, 0xfffd, 0xfffd, 0xfffd, 0xfffd, 0xfffd,
     0x05d0, 0x05d1, 0x05d2, 0x05d3, 0x05d4, 0x05d5, 0x05d6, 0x05d7, 0x05d8, 0x05d9, 0x05da, 0x05db,
     0x05dc, 0x05dd, 0x05de, 0x05df, 0x05e0, 0x05e1, 0x05e2, 0x05e3, 0x05e4, 0x05e5, 0x05e6, 0x05e7,
     0x05e8, 0x05e9, 0x05ea, 0xfffd, 0xfffd, 0x200e, 0x200f, 0xfffd},
    {0x20ac, 0x067e, 0x201a, 0x0192, 0x201e, 0x2026, 0x2020, 0x2021, 0x02c6, 0x2030, 0x0679, 0x2039,
     0x0152, 0x0686, 0x0698, 0x0688, 0x06af, 0x2018, 0x2019, 0x201c, 0x201d, 0x2022, 0x2013, 0x2014,
     0x06a9, 0x2122, 0x0691, 0x203a, 0x0153, 0x200c, 0x200d, 0x06ba, 0x00a0, 0x060c, 0x00a2, 0x00a3,
     0x00a4, 0x00a5, 0x00a6, 0x00a7, 0x00a8, 0x00a9, 0x06be, 0x00ab, 0x00ac, 0x00ad, 0x00ae, 0x00af,
     0x00b0, 0x00b1, 0x00b2, 0x00b3, 0x00b4, 0x00b5, 0x00b6, 0x00b7, 0x00b8, 0x00b9, 0x061b, 0x00bb,
     0x00bc, 0x00bd, 0x00be, 0x061f, 0x06c1, 0x0621, 0x0622, 0x0623, 0x0624, 0x0625, 0x0626, 0x0627,
     0x0628, 0x0629, 0x062a, 0x062b, 0x062c, 0x062d, 0x062e, 0x062f, 0x0630, 0x0631, 0x0632, 0x0633,
     0x0634, 0x0635, 0x0636, 0x00d7, 0x0637, 0x0638, 0x0639, 0x063a, 0x0640, 0x0641, 0x0642, 0x0643,
     0x00e0, 0x0644, 0x00e2, 0x0645, 0x0646, 0x0647, 0x0648, 0x00e7, 0x00e8, 0x00e9, 0x00ea, 0x00eb,
     0x0649, 0x064a, 0x00ee, 0x00ef, 0x064b, 0x064c, 0x064d, 0x064e, 0x00f4, 0x064f, 0x0650, 0x00f7,
     0x0651, 0x00f9, 0x0652, 0x00fb, 0x00fc, 0x200e, 0x200f, 0x06d2},
    {0x20ac, 0xfffd, 0x201a, 0xfffd, 0x201e, 0x2026, 0x2020, 0x2021, 0xfffd, 0x2030, 0xfffd, 0x2039,
     0xfffd, 0x00a8, 0x02c7, 0x00b8, 0xfffd, 0x2018, 0x2019, 0x201c, 0x201d, 0x2022, 0x2013, 0x2014,
     0xfffd, 0x2122, 0xfffd, 0x203a, 0xfffd, 0x00af, 0x02db, 0xfffd, 0x00a0, 0xfffd, 0x00a2, 0x00a3,
     0x00a4, 0xfffd, 0x00a6, 0x00a7, 0x00d8, 0x00a9, 0x0156, 0x00ab, 0x00ac, 0x00ad, 0x00ae, 0x00c6,
     0x00b0, 0x00b1, 0x00b2, 0x00b3, 0x00b4, 0x00b5, 0x00b6, 0x00b7, 0x00f8, 0x00b9, 0x0157, 0x00bb,
     0x00bc, 0x00bd, 0x00be, 0x00e6, 0x0104, 0x012e, 0x0100, 0x0106, 0x00c4, 0x00c5, 0x0118, 0x0112,
     0x010c, 0x00c9, 0x0179, 0x0116, 0x0122, 0x0136, 0x012a, 0x013b, 0x0160, 0x0143, 0x0145, 0x00d3,
     0x014c, 0x00d5, 0x00d6, 0x00d7, 0x0172, 0x0141, 0x015a, 0x016a, 0x00dc, 0x017b, 0x017d, 0x00df,
     0x0105, 0x012f, 0x0101, 0x0107, 0x00e4, 0x00e5, 0x0119, 0x0113, 0x010d, 0x00e9, 0x017a, 0x0117,
     0x0123, 0x0137, 0x012b, 0x013c, 0x0161, 0x0144, 0x0146, 0x00f3, 0x014d, 0x00f5, 0x00f6, 0x00f7,
     0x0173, 0x0142, 0x015b, 0x016b, 0x00fc, 0x017c, 0x017e, 0x02d9},
    {0x20ac, 0xfffd, 0x201a, 0x0192, 0x201e, 0x2026, 0x2020, 0x2021, 0x02c6, 0x2030, 0xfffd, 0x2039,
     0x0152, 0xfffd, 0xfffd, 0xfffd, 0xfffd, 0x2018, 0x2019, 0x201c, 0x201d, 0x2022, 0x2013, 0x2014,
     0x02dc, 0x2122, 0xfffd, 0x203a, 0x0153, 0xfffd, 0xfffd, 0x0178, 0x00a0, 0x00a1, 0x00a2, 0x00a3,
     0x00a4, 0x00a5, 0x00a6, 0x00a7, 0x00a8, 0x00a9, 0x00aa, 0x00ab, 0x00ac, 0x00ad, 0x00ae, 0x00af,
     0x00b0, 0x00b1, 0x00b2, 0x00b3, 0x00b4, 0x00b5, 0x00b6, 0x00b7, 0x00b8, 0x00b9, 0x00ba, 0x00bb,
     0x00bc, 0x00bd, 0x00be, 0x00bf, 0x00c0, 0x00c1, 0x00c2, 0x0102, 0x00c4, 0x00c5, 0x00c6, 0x00c7,
     0x00c8, 0x00c9, 0x00ca, 0x00cb, 0x0300, 0x00cd, 0x00ce, 0x00cf, 0x0110, 0x00d1, 0x0309, 0x00d3,
     0x00d4, 0x01a0, 0x00d6, 0x00d7, 0x00d8, 0x00d9, 0x00da, 0x00db, 0x00dc, 0x01af, 0x0303, 0x00df,
     0x00e0, 0x00e1, 0x00e2, 0x0103, 0x00e4, 0x00e5, 0x00e6, 0x00e7, 0x00e8, 0x00e9, 0x00ea, 0x00eb,
     0x0301, 0x00ed, 0x00ee, 0x00ef, 0x0111, 0x00f1, 0x0323, 0x00f3, 0x00f4, 0x01a1, 0x00f6, 0x00f7,
     0x00f8, 0x00f9, 0x00fa, 0x00fb, 0x00fc, 0x01b0, 0x20ab, 0x00ff},
};
// clang-format on

typedef struct code_page {
    const uint16_t *table; ///< NULL where it is of libxml2
    xmlCharEncodingHandler *handler;
    xmlBuffer *in, *out;
    xmlGenericErrorFunc told; ///< who was told of libxml2's errors before
    void *told_context;
    int escape;   ///< the digit of \M+
    bool guessed; ///< the drawing does not name it
    size_t unread;
} code_page;

/// The code page that a name such as "ANSI_1252" stands for: its number; 0 where there is none.
static int number_of(const char *name) {
    static const struct {
        const char *name;
        int number;
    } others[] = {
        {"GB2312", 936}, {"BIG5", 950}, {"KSC5601", 949}, {"JOHAB", 1361}, {"MACINTOSH", 10000}};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (sli_dxf_same_name((sli_word){name, strlen(name)},
                              (sli_word){others[i].name, strlen(others[i].name)}))
            return others[i].number;
    const size_t letters = strcspn(name, "0123456789");
    const long number = strtol(name + letters, NULL, 10);
    return strncmp(name, "8859", 4) == 0 || number > 10000 ? 0 : (int)number;
}

static xmlCharEncodingHandler *open_handler(const char *name, int number) {
    char other[24];
    if (number)
        snprintf(other, sizeof other, "CP%d", number);
    else if (strncmp(name, "8859_", 5) == 0)
        snprintf(other, sizeof other, "ISO-8859-%.2s", name + 5);
    else
        return NULL;
    xmlCharEncodingHandler *handler = xmlFindCharEncodingHandler(other);
    if (handler) return handler;
    const char *const second = number == 932     ? "SHIFT_JIS"
                               : number == 936   ? "GBK"
                               : number == 949   ? "EUC-KR"
                               : number == 950   ? "BIG5"
                               : number == 1361  ? "JOHAB"
                               : number == 10000 ? "MACINTOSH"
                                                 : NULL;
    return second ? xmlFindCharEncodingHandler(second) : NULL;
}

/// A byte that is no character is told of in another way.
static void tell_nobody(void *user, const char *message, ...) {
    (void)user, (void)message;
}

static void open_page(code_page *page, const char *name) {
    static const int escapes[] = {932, 950, 949, 1361, 936};
    const int number = number_of(name);
    *page = (code_page){.table = number >= 1250 && number <= 1258 ? windows[number - 1250] : NULL};
    for (int i = 0; i < 5; i++)
        if (number == escapes[i]) page->escape = i + 1;
    if (!page->table) page->handler = open_handler(name, number);
    if (!page->handler) return;
    page->told = xmlGenericError;
    page->told_context = xmlGenericErrorContext;
    xmlSetGenericErrorFunc(NULL, tell_nobody);
    page->in = xmlBufferCreate();
    page->out = xmlBufferCreate();
}

static void close_page(code_page *page) {
    if (!page->handler) return;
    xmlCharEncCloseFunc(page->handler);
    xmlSetGenericErrorFunc(page->told_context, page->told);
    xmlBufferFree(page->in);
    xmlBufferFree(page->out);
}

// --- values

static size_t put_utf8(char *to, uint32_t c) {
    if (c < 0x80) {
        to[0] = (char)c;
        return 1;
    }
    const size_t more = c < 0x800 ? 1 : c < 0x10000 ? 2 : 3;
    static const unsigned char lead[] = {0, 0xc0, 0xe0, 0xf0};
    to[0] = (char)(lead[more] | c >> (6 * more));
    for (size_t i = 1; i <= more; i++) to[i] = (char)(0x80 | (c >> (6 * (more - i)) & 0x3f));
    return more + 1;
}

/// The characters of a value that libxml2 reads; false where it cannot.
static bool read_by_handler(code_page *page, sli_word value, char *to, size_t *length) {
    if (!page->handler || !page->in || !page->out || value.length > 10000) return false;
    xmlBufferEmpty(page->in);
    xmlBufferEmpty(page->out);
    if (xmlBufferAdd(page->in, (const xmlChar *)value.at, (int)value.length) != 0) return false;
    const int written = xmlCharEncInFunc(page->handler, page->out, page->in);
    const int count = xmlBufferLength(page->out);
    if (written <= 0 || xmlBufferLength(page->in) != 0 || (size_t)count > 4 * value.length)
        return false;
    memcpy(to, xmlBufferContent(page->out), (size_t)count);
    *length = (size_t)count;
    return true;
}

/// Writes a value's bytes as characters: at most 8 for each. `page` NULL: they are UTF-8 as they
/// are.
static size_t read_bytes(code_page *page, sli_word value, char *to) {
    size_t length = 0;
    if (page && !page->table && read_by_handler(page, value, to, &length)) return length;
    bool unread = false;
    for (size_t i = 0; i < value.length; i++) {
        const unsigned c = (unsigned char)value.at[i];
        if (c < 0x80 || !page) {
            to[length++] = (char)c;
        } else if (page->table) {
            length += put_utf8(to + length, page->table[c - 0x80]);
        } else {
            const bool pair = page->escape && i + 1 < value.length;
            const unsigned second = pair ? (unsigned char)value.at[++i] : 0;
            length += (size_t)sprintf(to + length, "\\M+%d%04X", page->escape,
                                      pair ? c << 8 | second : c);
            unread = true;
        }
    }
    if (page) page->unread += unread;
    return length;
}

static bool read_hex(const char *at, size_t left, uint32_t *value) {
    *value = 0;
    for (int i = 0; i < 4; i++) {
        const char c = left > (size_t)i ? at[i] : ' ';
        const char small = (char)(c | 0x20);
        if (!((c >= '0' && c <= '9') || (small >= 'a' && small <= 'f'))) return false;
        *value = *value << 4 | (uint32_t)(c <= '9' ? c - '0' : small - 'a' + 10);
    }
    return true;
}

/// \U+xxxx, or two of them for a character beyond U+FFFF. Its length; 0 where there is none.
static size_t read_escape(const char *at, size_t left, uint32_t *c) {
    if (left < 7 || memcmp(at, "\\U+", 3) != 0 || !read_hex(at + 3, left - 3, c)) return 0;
    if (*c < ' ' || *c == 0x7f || (*c >= 0xdc00 && *c < 0xe000)) return 0;
    if (*c < 0xd800 || *c >= 0xe000) return 7;
    uint32_t low;
    if (left < 14 || memcmp(at + 7, "\\U+", 3) != 0 || !read_hex(at + 10, left - 10, &low) ||
        low < 0xdc00 || low >= 0xe000)
        return 0;
    *c = 0x10000 + ((*c - 0xd800) << 10) + (low - 0xdc00);
    return 14;
}

/// Replaces escapes in place: a character in UTF-8 is shorter than its escape.
static size_t read_escapes(char *text, size_t length) {
    size_t written = 0;
    for (size_t i = 0; i < length;) {
        uint32_t c;
        const size_t escape = text[i] == '\\' ? read_escape(text + i, length - i, &c) : 0;
        if (escape)
            written += put_utf8(text + written, c);
        else
            text[written++] = text[i];
        i += escape ? escape : 1;
    }
    return written;
}

// --- the drawing

static bool has_high_byte(sli_word value) {
    for (size_t i = 0; i < value.length; i++)
        if ((unsigned char)value.at[i] >= 0x80) return true;
    return false;
}

/// Whether a value has neither bytes beyond ASCII nor anything that may be an escape.
static bool is_plain(sli_word value) {
    bool plain = true;
    for (size_t i = 0; i < value.length; i++)
        plain &= (unsigned char)value.at[i] < 0x80 && value.at[i] != '\\';
    return plain;
}

/// A variable of the header; of no length where there is none.
static sli_word header_variable(const sli_dxf *dxf, const char *name) {
    for (size_t i = 0; i + 1 < dxf->pairs.count; i++) {
        const sli_dxf_pair *pair = sli_dxf_at(dxf, i);
        if (pair->code == 0 && sli_word_is(pair->value, "ENDSEC")) break;
        if (pair->code == 9 && sli_word_is(pair->value, name)) return pair[1].value;
    }
    return (sli_word){"", 0};
}

/// Whether a value's bytes beyond ASCII are UTF-8. `*long_ones` stays if each has three or more.
static bool is_utf8(sli_word value, bool *long_ones) {
    for (size_t i = 0; i < value.length; i++) {
        const size_t begin = i;
        for (; i < value.length && (unsigned char)value.at[i] >= 0x80; i++)
            *long_ones &= (unsigned char)value.at[i] < 0xc0 || (unsigned char)value.at[i] >= 0xe0;
        if (i > begin && !sli_name_usable(value.at + begin, i - begin)) return false;
    }
    return true;
}

/// Whether libxml2 reads all values in a page.
static bool reads_all(const sli_dxf *dxf, code_page *page) {
    char *text = NULL;
    size_t room = 0, length;
    bool all = true;
    for (size_t i = 0; all && i < dxf->pairs.count; i++) {
        const sli_word value = sli_dxf_at(dxf, i)->value;
        if (!has_high_byte(value)) continue;
        if (4 * value.length > room) {
            sl_free(dxf->context, text);
            text = sl_alloc(dxf->context, room = 4 * value.length);
        }
        all = text && read_by_handler(page, value, text, &length);
    }
    sl_free(dxf->context, text);
    return all;
}

static bool is_letter(char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

/// Whether bytes are Japanese (Shift JIS) by their look: characters of two bytes throughout, most
/// of them begun by what is hardly a letter in any page of one byte, and some with two high bytes.
static bool looks_japanese(const sli_dxf *dxf) {
    size_t begun = 0, letters = 0, high = 0;
    for (size_t i = 0; i < dxf->pairs.count; i++) {
        const sli_word value = sli_dxf_at(dxf, i)->value;
        for (size_t k = 0; k < value.length; k++) {
            const unsigned c = (unsigned char)value.at[k];
            if (c < 0x80) continue;
            letters++;
            if (c >= 0xa1 && c <= 0xdf) continue; // of one byte
            if (c == 0x80 || c == 0xa0 || c > 0xfc || ++k == value.length) return false;
            const unsigned second = (unsigned char)value.at[k];
            if (second < 0x40 || second == 0x7f || second > 0xfc) return false;
            begun += c < 0xa0;
            // Behind a letter it may be an apostrophe or a dash.
            high += c < 0xa0 && second >= 0x80 && (k == 1 || !is_letter(value.at[k - 2]));
        }
    }
    return high && 2 * begun > letters;
}

/// The page of a drawing that names none: Japanese where all of it can be read so, else that of
/// Western Europe.
static void guess_page(const sli_dxf *dxf, code_page *page) {
    if (looks_japanese(dxf)) {
        open_page(page, "ANSI_932");
        page->guessed = true;
        if (page->handler && reads_all(dxf, page)) return;
        close_page(page);
    }
    *page = (code_page){.table = windows[2], .guessed = true};
}

/// Finds the page of the values that have bytes beyond ASCII. None where they are UTF-8.
static bool find_page(const sli_dxf *dxf, bool all_utf8, bool long_ones, code_page *page) {
    const sli_word version = header_variable(dxf, "$ACADVER");
    const sli_word named = header_variable(dxf, "$DWGCODEPAGE");
    char name[24] = "";
    if (version.length == 6 && memcmp(version.at, "AC1021", 6) >= 0) return false;
    snprintf(name, sizeof name, "%.*s", (int)(named.length < 20 ? named.length : 20), named.at);
    open_page(page, name);
    if (all_utf8 && (long_ones || !page->escape)) {
        close_page(page);
        return false;
    }
    if (page->table || page->handler || page->escape) return true;
    guess_page(dxf, page);
    return true;
}

void sli_dxf_note_names(const sli_dxf *dxf) {
    const sli_word named = header_variable(dxf, "$DWGCODEPAGE");
    const size_t unread = dxf->unread_names;
    if (dxf->guessed_page)
        sl_note(dxf->context, "%s: names are read as of the code page ANSI_%d: the drawing %s%s",
                dxf->name, dxf->guessed_page, named.length ? "has an unknown one, " : "names none",
                sli_show(named).text);
    if (unread)
        sl_note(
            dxf->context,
            "%s: %zu name%s or text%s of the code page %s cannot be read here; their characters "
            "are shown by their numbers, as in \\M+18140",
            dxf->name, unread, unread == 1 ? "" : "s", unread == 1 ? "" : "s",
            sli_show(named).text);
}

sl_status sli_dxf_decode_names(sli_dxf *dxf) {
    size_t bytes = 0;
    bool all_utf8 = true, long_ones = true, any = false;
    for (size_t i = 0; i < dxf->pairs.count; i++) {
        const sli_word value = sli_dxf_at(dxf, i)->value;
        if (is_plain(value)) continue;
        bytes += 8 * value.length;
        any |= has_high_byte(value);
        all_utf8 &= is_utf8(value, &long_ones);
    }
    if (!bytes) return SL_OK;
    code_page page = {0};
    char *to = dxf->names = sl_alloc(dxf->context, bytes + 1); // an escape is written with its zero
    if (!to) return SL_NO_MEMORY;
    const bool paged = any && find_page(dxf, all_utf8, long_ones, &page);
    for (size_t i = 0; i < dxf->pairs.count; i++) {
        sli_word *value = &dxf->pairs.items[i].value;
        if (is_plain(*value)) continue;
        const size_t length = read_escapes(to, read_bytes(paged ? &page : NULL, *value, to));
        *value = (sli_word){to, length};
        to += length;
    }
    if (!paged) return SL_OK;
    dxf->unread_names = page.unread;
    dxf->guessed_page = !page.guessed ? 0 : page.table ? 1252 : 932;
    close_page(&page);
    return SL_OK;
}
