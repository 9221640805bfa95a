// What names of layers mean: codes of standards, and everyday names in many languages.
#include "testing.h"

#include "io/parts/meaning.h"

static void assert_means(sli_meaning expected, const char *const *names, size_t count) {
    for (size_t i = 0; i < count; i++) {
        const sli_meaning found = sli_meaning_of((sli_word){names[i], strlen(names[i])});
        if (found != expected)
            fail_msg("'%s' means '%s', not '%s'", names[i], sli_meaning_text(found),
                     sli_meaning_text(expected));
    }
}
#define MEANS(meaning, ...)                                                                        \
    do {                                                                                           \
        static const char *const names[] = {__VA_ARGS__};                                          \
        assert_means(meaning, names, sizeof names / sizeof *names);                                \
    } while (0)

static void test_standards(void **state) {
    (void)state;
    MEANS(SLI_MEANS_WALL, "A-WALL", "A-WALL-FULL", "S-COLS", "a_wall", "A-21----E-N----",
          "B-22-12--E-", "xref-furniture|A-WALL", "plan$0$A-WALL", "COLUMN");
    MEANS(SLI_MEANS_DOOR, "A-DOOR", "A-DOOR-FULL", "A-32----E-", "OPENINGS",
          "Wandöffnung öffnungen", "ouvertures", "vanos", "проемы");
    MEANS(SLI_MEANS_GRID, "0-0_グリッド");
    MEANS(SLI_MEANS_SITE, "outside", "Outdoors");
    MEANS(SLI_MEANS_WALL, "outside walls");
    MEANS(SLI_MEANS_WINDOW, "A-GLAZ", "A-GLAZ-CURT", "WINDOW", "A-31----E-");
    MEANS(SLI_MEANS_FURNITURE, "I-FURN", "A-EQPM", "P-FIXT", "E-LITE", "furniture|0", "Bed",
          "Room furniture");
    MEANS(SLI_MEANS_NOTHING, "BedRoom", "WC room 2", "table_room", "Kitchen");
    MEANS(SLI_MEANS_TEXT, "A-ANNO-DIMS", "A-WALL-IDEN", "PUB_DIM", "A-21----T-N----", "mtext");
    MEANS(SLI_MEANS_HATCH, "A-WALL-PATT", "A-21----H-");
    MEANS(SLI_MEANS_STAIRS, "A-FLOR-STRS", "A-24----E-");
    MEANS(SLI_MEANS_GRID, "S-GRID", "DOTE", "A-WALL-CNTR", "walking graph", "nodes", "rfid2");
    MEANS(SLI_MEANS_SITE, "C-TOPO", "L-PLNT");
    MEANS(SLI_MEANS_FRAME, "G-ANNO|TTLB", "Defpoints", "VIEWPORT");
    MEANS(SLI_MEANS_OTHER, "A-CLNG", "A-WALL-DEMO", "A-ROOF", "A-27----E-");
}

static void test_languages(void **state) {
    (void)state;
    MEANS(SLI_MEANS_WALL, "Walls", "walls_ext", "WallExterior", "0_WAND", "Außenwände",
          "Trennwände tragend", "MAUERWERK", "MURS", "Cloisons", "murs porteurs", "muratura",
          "Tramezzi", "Pareti interne", "MUROS EXTERIORES", "Tabiquería", "Paredes", "Alvenaria",
          "Binnenmuren", "buitenwand", "Стены", "СТЕНЫ НАРУЖНЫЕ", "перегородки", "Ściany", "Stěny",
          "příčky", "DUVAR", "Yttervägg", "Vegger", "Væg", "墙体", "墙", "牆", "壁", "間仕切壁",
          "벽체", "ＷＡＬＬ");
    MEANS(SLI_MEANS_DOOR, "Türen", "TUEREN", "portes", "Porta", "Puertas", "Deuren", "Двери",
          "drzwi", "Dveře", "KAPI", "Kapılar", "Dörrar", "dør", "门", "ドア", "扉", "문");
    MEANS(SLI_MEANS_WINDOW, "Fenster", "Fenêtres", "Infissi", "Ventanas", "Janelas", "Kozijnen",
          "Окна", "okna", "Pencere", "Fönster", "vindue", "窗", "门窗", "建具", "창문",
          "curtain wall", "Window frames");
    MEANS(SLI_MEANS_FURNITURE, "Möbel", "mobilier", "Arredi", "MOBILIARIO", "Мебель", "meble",
          "Mobilya", "家具", "가구", "给排水", "San Fittings", "Wandschrank", "CHAIR-01", "Toilet");
    MEANS(SLI_MEANS_TEXT, "Bemaßung", "cotes", "QUOTE", "Acotado", "Cotas", "Размеры", "wymiary",
          "kóty", "ölçü", "标注", "寸法", "치수", "문자", "drywall notes", "window schedule text");
    MEANS(SLI_MEANS_HATCH, "Schraffur", "hachures", "Retini", "sombreado", "Штриховка",
          "wall hatch", "填充", "ハッチ", "해치", "tiling");
    MEANS(SLI_MEANS_STAIRS, "Treppen", "escalier", "Scale", "escaleras", "лестница", "schody",
          "merdiven", "楼梯", "階段", "계단");
    MEANS(SLI_MEANS_GRID, "Achsen", "AXES", "Assi", "ejes", "Оси", "osie", "aks", "轴线", "通り芯");
    MEANS(SLI_MEANS_SITE, "Bäume", "jardin", "alberi", "Árboles", "озеленение", "绿化", "植栽");
    MEANS(SLI_MEANS_FRAME, "Plankopf", "cartouche", "Cajetín", "штамп", "图框", "図枠", "border");
}

/// Words that only sound alike, and names that programs give by themselves.
static void test_nothing(void **state) {
    (void)state;
    MEANS(SLI_MEANS_NOTHING, "", "0", "Layer 1", "layer1", "path1234", "g12", "GROUND FLOOR PLAN",
          "rooms", "kitchen", "cls-1", "st0", "Natur", "Stand", "Wandleuchten", "_x", "\\U+",
          "\xff\xfe", "\xe5", "----------", "A---------");
    MEANS(SLI_MEANS_OTHER, "wallpaper", "Leinwand", "梁", "BS-梁");
}

/// Letters as numbers, accents behind their letters, and bytes that are no UTF-8.
static void test_letters(void **state) {
    (void)state;
    MEANS(SLI_MEANS_WALL, "W\\U+00E4nde", "\\U+5899", "W_xE4_nde", "Wa\xcc\x88nde", "W\xe4nde",
          "Walls_x5F_ext", "W\xc3\x84NDE");
}

static void test_long_names(void **state) {
    (void)state;
    char name[4096];
    memset(name, 'x', sizeof name);
    memcpy(name + 2000, " wall ", 6);
    assert_int_equal(sli_meaning_of((sli_word){name, sizeof name}), SLI_MEANS_WALL);
    memset(name, 'x', sizeof name);
    assert_int_equal(sli_meaning_of((sli_word){name, sizeof name}), SLI_MEANS_NOTHING);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_standards),  cmocka_unit_test(test_languages),
        cmocka_unit_test(test_nothing),    cmocka_unit_test(test_letters),
        cmocka_unit_test(test_long_names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
