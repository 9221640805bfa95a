/// The words by which authors of plans name layers.
///
/// A name is cut into words: runs of letters, which end before a capital behind a small letter.
/// Letters are folded first: capitals become small, accents go. A word is then held against the
/// lists below. A pattern stands for itself and its plural by s or es; "wand*" for all words that
/// begin so, "*wand" for those that end so ("Trennwand"), "*墙*" for those that have it anywhere,
/// as is needed where words are not set apart. Words of German and Dutch that only begin with
/// "wand" (wall lamps) are no walls.
///
/// Sources of codes: the US National CAD Standard (A-WALL, A-GLAZ, I-FURN), ISO 13567, and the
/// names that CAD programs for one trade give to their own layers (DOTE, PUB_DIM).
#include "io/parts/meaning.h"

#include <string.h>

// --- the words

typedef struct word_list {
    const char *text;     ///< of the meaning, for messages
    const char *patterns; ///< with blanks between
} word_list;

/// Glass, of which a whole wall may be: "curtain wall".
#define GLASS                                                                                                    \
    "glaz* glass curtain* storefront verglasung* glas vitrage* vitre* vetrat* vetro vetri "                      \
    "vidrio* cristal* crystal* vidro* beglazing витраж* остеклен* стекл* szyb* zaskleni cam " \
    "camlar "                                                                                                    \
    "*幕墙* *玻璃* *ガラス* *유리*"

/// Nodes of a route graph, as for finding one's way indoors.
#define ROUTE_NODES "node rfid* reader* waypoint* graph* route*"

static const word_list lists[SLI_MEANINGS] = {
    [SLI_MEANS_NOTHING] = {"", ""},
    [SLI_MEANS_WALL] =
        {"wall",
         "wall wal wallext wallint *wall *walls partition* prtn col column* pillar pier masonry "
         "brick* blockwork cmu concrete stud gypsum core shaft facade* structure* structural "
         "wand wande waende wanden *wand *wande *waende *wanden mauer* *mauer *mauern stutze* "
         "stuetze* saule* saeule* pfeiler* tragend* nichttragend* fassade* tragwerk* rohbau "
         "mur muret* cloison* poteau* pilier* maconnerie refend* voile "
         "muro muri mura muratur* parete pareti tramezz* pilastr* colonn* tamponament* setto setti "
         "pared paredes tabique* mamposteria columna* pilar* cerramiento* fachada* medianera* "
         "parede* alvenaria* coluna* divisoria* "
         "muur muren *muur *muren kolom* gevel* "
         "стен* *стена *стены перегород* колонн* пилон* steny peregorodk* kolonn* "
         "scian* mury slup* stena sten zed zdi zdiv* pricka pricky pricek sloup* stlp* "
         "duvar* kolon kolonlar bolme "
         "vagg* *vagg *vaggar vag vaeg* vegg* *vegg *vegger *vaeg pelare* soyle* sojle* "
         "seina* fal falak perete pereti zid ziduri "
         "*墙* *墻* *牆* *壁* *間仕切* *隔断* *柱* *벽* *기둥* جدار جدران حائط קיר קירות"},
    [SLI_MEANS_FRAME] =
        {"frame",
         "title* ttlb tblock border* frame sheet* nplt noplot vprt viewport* vport* vp defpoints "
         "margin logo north nord norte compass plotrahmen rahmen* schriftfeld* plankopf* "
         "blattrahmen cartouche* cadre* cartiglio squadratura* cornice cajetin* recuadro rotulo* "
         "formato* carimbo* folha* moldura* selo kader* titelhoek* stempel* рамк* штамп* формат* "
         "видов* ramk* tabelk* razitk* ramec* antet* pafta* cerceve* ritram* tittelfelt* *图框* "
         "*圖框* *图签* *视口* *图廓* *図枠* *도곽* *指北针*"},
    [SLI_MEANS_DOOR] =
        {"door",
         "door* *door *doors gate* opening ouverture* oeffnung* offnung* vano apertur* abertura* "
         "проем* "
         "tur ture turen tuer tuere tueren *tuer *tueren innentur* "
         "aussentur* haustur* schiebetur* tor tore porte porta portas portail puerta* porton "
         "portao deur deuren *deur *deuren двер* *дверь *двери ворот* dveri drzwi* brama dvere "
         "dver* vrata kapi kapilar* dorr dorrar dor dorer dore ovi ovet ajto* usa usi *门* *門* "
         "*ドア* *扉* *문* باب أبواب דלת דלתות"},
    [SLI_MEANS_WINDOW] =
        {"window", GLASS
         " window* *window *windows win wndw wdw skylight* fenster* *fenster fenetre* baie "
         "chassis menuiserie* finestr* infiss* serrament* ventana* carpinteria* janela* "
         "esquadria* caixilh* raam ramen kozijn* venster* окн* окон* okno okna okien* okienn* "
         "pencere* fonster* vindu* ikkuna* ablak* fereastr* ferestre *窗* *窓* *サッシ* *建具* "
         "*창* نافذة نوافذ חלון חלונות"},
    [SLI_MEANS_OTHER] =
        {"other",
         "demo demol* abbruch* abriss* derrib* демонт* *拆除* wallpaper* wallcovering* tapete* "
         "leinwand* roof* dach* toiture* tetto tetti copertur* cubierta* techo* tejado* telhado* "
         "dak крыш* кровл* strech* cati yttertak *屋顶* *屋根* *지붕* ceil* clng rcp decke* "
         "plafond* controsoffitt* soffitt* forro* потол* sufit* strop* *天花* *吊顶* *天井* "
         "*천장* *梁* flor slab* beam* joist* rafter* footing* foundation* fndn fundament* "
         "overhead "
         "ovhd above hidden hidd unterzug* elevation* sect section* detail* detl ansicht* "
         "schnitt* coupe* sezion* seccion* alzado* corte* doorsnede* разрез* przekr* rez rezy "
         "kesit* gorunus* area"},
    [SLI_MEANS_SITE] =
        {"site",
         "site* landscape* plnt plant* tree shrub* hedge* garden* vegetat* lawn grass topo* "
         "contour* property prop parking prkg road* street* sidewalk* curb kerb fence* survey* "
         "terrain* grundstuck* gelande* gelaende* garten* aussenanlage* baum baume baeume "
         "pflanz* bepflanzung* strasse* lageplan* zaun* jardin* arbre* cloture* voirie verde "
         "alberi albero giardin* terreno* strada* recinzion* vegetaz* arbol* parcela* valla* "
         "calle* jardim jardins arvore* paisag* lote tuin* boom bomen terrein* straat groen "
         "участ* озелен* дерев* рельеф* дорог* благоустр* генплан* газон* zielen* teren* drzew* "
         "dzialk* ogrodzeni* zelen* strom* pozemek* oplocen* peyzaj* agac* bitki* arazi* bahce* "
         "tomt* trad *绿化* *植物* *树* *景观* *地形* *道路* *植栽* *外構* *敷地* *조경* *대지* "
         "*도로*"},
    [SLI_MEANS_GRID] =
        {"grid", ROUTE_NODES
         " grid* axis axes axe paths wayfinding coordinate* centerline* centreline* center centre "
         "cntr guide* datum dote achse* raster* hilfslinie* mittellinie* trame asse assi interass* "
         "eje eixo stramien* assen ось "
         "оси осеи осей осев* os osi osie osy aks akslar axel stomlinj* modullinj* akse akser "
         "*轴* *軸* *グリッド* *通り芯* *通芯* *基準線* *축* *중심선*"},
    [SLI_MEANS_STAIRS] =
        {"stairs",
         "stair* strs step riser* tread* ramp escalator* elevator* elev lift evtr handrail* rail "
         "railing* hral guardrail* balustrad* treppe* *treppe *treppen stufe* rampe* gelander* "
         "gelaender* aufzug* escalier* marche* garde ascenseur* scala scale scalini gradini "
         "rampa* ringhier* ascensor* corrimano escalera* peldano* barandilla* baranda* escada* "
         "degrau* corrimao elevador* trap trappen *trap leuning liften лестниц* ступен* перил* "
         "огражден* лифт* пандус* schod* winda dzwig* zabradli vytah* merdiven* korkuluk* "
         "asansor* trappa* trappor trappe* hiss heis *楼梯* *樓梯* *梯* *栏杆* *扶手* *台阶* "
         "*階段* *手摺* *계단* *난간*"},
    [SLI_MEANS_FURNITURE] =
        {"furniture",
         "furnit* furn furnish* casework millwork cabinet* eqpm eqpt equip* appliance* fixture* "
         "fixt fixd fitting* sanit* plumb* plmb toilet* wc lavator* lav sink basin washbasin* "
         "bathtub* tub "
         "shower* chair* armchair* seat seating sofa* couch* table desk bed bookcase* bookshel* "
         "shelf shelves shelving rack wardrobe* stove* oven fridge* refrigerator* dishwasher* "
         "washer* dryer* lamp lite lighting luminair* elec electr* powr power switch* outlet* "
         "socket* hvac duct* pipe piping sprinkler* mech mechanic* people person car vehicle* "
         "entourage decor* mobel* moebel* moblier* mobil mobili mobiliar* mobilier* mobilia* "
         "mobilya* mobler* einricht* elektr* heizung* luftung* lueftung* stuhl* tisch* bett* "
         "*schrank *schranke schrank* leuchte* beleucht* ausstattung* meuble* plomber* chaise* "
         "fauteuil* arred* impiant* elettr* sedia sedie letto letti tavol* mueble* equipam* "
         "fontaneria silla* mesa cama moveis movel louca cadeira* eletric* hidraul* meubel* "
         "meubilair* inrichting* installati* мебел* mebel* сантех* оборудован* электр* "
         "светильник* отоплен* вентиляц* водоснаб* mebl* wyposaz* nabyt* zarizov* zarizeni "
         "tefris* donati* vitrifiye* inredning* innredning* inventar* kaluste* butor* *家具* "
         "*家俱* *洁具* *潔具* *设备* *設備* *卫浴* *灯具* *什器* *備品* *衛生* *便器* *가구* "
         "*위생* *설비* *电气* *電気* *电器* *给排水* *給排水* أثاث ריהוט"},
    [SLI_MEANS_HATCH] =
        {"hatch",
         "hatch* htch patt pattern* poche fill infill solidfill shading shade tile tiling paving "
         "pavement* flooring texture* insulat* insul insl schraff* muster* fullung* fuellung* "
         "fliese* bodenbelag* dammung* daemmung* belag hachur* rempliss* carrel* dallage isolant* "
         "isolation* revetement* retino retini campitur* tratteggi* riempim* piastrell* "
         "isolament* sombread* rayad* trama relleno* baldosa* solado aislam* aislant* preenchim* "
         "revestim* arcering* vulling* tegel* isolatie* штрих* заливк* плитк* утепл* kreskowan* "
         "szraf* wypeln* posadzk* sraf* vypln* dlazb* tarama* dolgu* seramik* skraffer* skraver* "
         "*填充* *图案* *剖面线* *铺装* *铺地* *地砖* *ハッチ* *タイル* *해치*"},
    [SLI_MEANS_TEXT] =
        {"text",
         "text* txt mtext anno annot* note notation label* lettering dim dims dimension* leader "
         "tag glyph* symb symbol* iden ident schedule* sched legend* number* numbering rev "
         "revision* "
         "revc cloud keynote* name header caption* beschrift* beschr bemas* masslini* maslini* "
         "vermass* vermas* hinweis* cote cotation* cota acotac* acotad* etiquett* etiqueta* nom "
         "testo testi quota quote quotat* annotaz* etichett* scritte nomi rotul* leyenda* cotagem "
         "maat maten maatvoer* opmerking* tekst* текст* размер* razmer* надпис* подпис* выноск* "
         "обознач* примеч* отметк* маркир* эксплик* wymiar* opis* popis* kota koty kotov* yazi* "
         "olcu* metin* matt mattsatt* malsaet* malsat* szoveg* meret* *文字* *标注* *標註* "
         "*標注* *尺寸* *注释* *说明* *图例* *名称* *寸法* *注記* *室名* *치수* *문자* *주석*"},
    [SLI_MEANS_LOW] = {"low", ""},
};

/// What makes a room of the furniture that is named before it.
static const char rooms[] = "room zimmer raum raume chambre salle stanza sala cuarto quarto kamer "
                            "ruimte pokoj комнат* zone hall lobby";

/// What has no walls where there are nodes of a route graph.
static const char edges[] = "edge link";

/// Ways in and out, which are no doors and no windows by name.
static const char ways_in[] =
    "entrance entree entry exit eingang* ausgang* zugang* sortie acces entrada salida acceso saida "
    "ingresso uscita ingang uitgang вход* выход* wejsci* wyjsci* giris cikis *入口* *出口* *玄関* "
    "*현관*";

/// What is around a building, where rooms are named one by one. With another word it says where
/// that stands: "outside walls".
static const char outside[] = "outside outdoor outdoors";

const char *sli_meaning_text(sli_meaning meaning) {
    return lists[meaning].text;
}

// --- letters

/// Letters from U+00C0 to U+017F without accents; a blank is none.
static const char latin[] =
    "aaaaaaaceeeeiiiidnooooo ouuuuytsaaaaaaaceeeeiiiidnooooo ouuuuyty"
    "aaaaaaccccccccddddeeeeeeeeeegggggggghhhhiiiiiiiiiijjjjkkkllllllllllnnnnnnnnnoooooooo"
    "rrrrrrssssssssttttttuuuuuuuuuuuuwwyyyzzzzzzs";

/// The character at `*at`, which moves behind it. A byte that begins none counts by itself.
static uint32_t next_plain(const char **at, const char *end) {
    const unsigned char first = (unsigned char)*(*at)++;
    const int more = first < 0xC2 ? 0 : first < 0xE0 ? 1 : first < 0xF0 ? 2 : first < 0xF5 ? 3 : 0;
    if (!more || end - *at < more) return first;
    uint32_t code = first & (0x3Fu >> more);
    for (int i = 0; i < more; i++) {
        if (((unsigned char)(*at)[i] & 0xC0) != 0x80) return first;
        code = code << 6 | ((unsigned char)(*at)[i] & 0x3F);
    }
    *at += more;
    return code;
}

/// A character that is written as a number behind `lead`: \U+5899, _xE4_. False for none.
static bool read_number(const char **at, const char *end, const char *lead, size_t most,
                        char behind, uint32_t *code) {
    const size_t length = strlen(lead);
    const char *digit = *at + length;
    if ((size_t)(end - *at) < length || memcmp(*at, lead, length) != 0) return false;
    *code = 0;
    while (digit < end && (size_t)(digit - *at) < length + most) {
        const char small = (char)(*digit | 0x20);
        const bool decimal = *digit >= '0' && *digit <= '9';
        if (!decimal && !(small >= 'a' && small <= 'f')) break;
        *code = *code << 4 | (uint32_t)(decimal ? *digit - '0' : small - 'a' + 10);
        digit++;
    }
    if (digit == *at + length || (behind && (digit == end || *digit != behind))) return false;
    *at = digit + (behind != 0);
    return true;
}

static uint32_t next_character(const char **at, const char *end) {
    uint32_t code;
    if (read_number(at, end, "\\U+", 4, 0, &code) || read_number(at, end, "_x", 5, '_', &code))
        return code;
    return next_plain(at, end);
}

/// A folded letter: without its accent, small. 0 for what is none, UINT32_MAX for an accent that
/// stands behind its letter.
static uint32_t fold(uint32_t code) {
    if (code >= 0xFF01 && code <= 0xFF5E) code -= 0xFEE0; // wide Latin letters
    if (code >= 'A' && code <= 'Z') return code + 0x20;
    if (code < 0x80) return code >= 'a' && code <= 'z' ? code : 0;
    if (code >= 0xC0 && code < 0x180) {
        const unsigned char plain = (unsigned char)latin[code - 0xC0];
        return plain == ' ' ? 0 : plain;
    }
    if (code < 0x180) return 0;
    if (code >= 0x218 && code <= 0x21B) return code < 0x21A ? 's' : 't';
    if (code >= 0x300 && code < 0x370) return UINT32_MAX;
    if (code >= 0x410 && code < 0x430) return code + 0x20;
    if (code == 0x401 || code == 0x451) return 0x435;
    return (code >= 0x2000 && code < 0x2E80) || (code >= 0x3000 && code < 0x3040) ? 0 : code;
}

// --- words

enum { LONGEST = 96 };

static size_t put(char *text, uint32_t code) {
    if (code < 0x80) {
        text[0] = (char)code;
        return 1;
    }
    if (code < 0x800) {
        text[0] = (char)(0xC0 | code >> 6);
        text[1] = (char)(0x80 | (code & 0x3F));
        return 2;
    }
    text[0] = (char)(0xE0 | (code >> 12 & 0xF));
    text[1] = (char)(0x80 | (code >> 6 & 0x3F));
    text[2] = (char)(0x80 | (code & 0x3F));
    return 3;
}

/// The next word, folded; moves behind it. Its end is cut off where it is too long. Empty at the
/// end.
static sli_word next_word(const char **at, const char *end, char text[LONGEST]) {
    size_t length = 0;
    bool was_small = false;
    while (*at < end) {
        const char *before = *at;
        const uint32_t code = next_character(at, end), letter = fold(code);
        const bool capital = code >= 'A' && code <= 'Z';
        if (letter == UINT32_MAX) continue;
        if (!letter && length) break;
        if (length && capital && was_small) {
            *at = before;
            break;
        }
        was_small = code >= 'a' && code <= 'z';
        if (letter && length + 4 < LONGEST) length += put(text + length, letter);
    }
    return (sli_word){text, length};
}

static bool ends_with(sli_word word, sli_word end) {
    return word.length >= end.length &&
           memcmp(word.at + word.length - end.length, end.at, end.length) == 0;
}

static bool has_part(sli_word word, sli_word part) {
    for (size_t i = 0; i + part.length <= word.length; i++)
        if (memcmp(word.at + i, part.at, part.length) == 0) return true;
    return false;
}

static bool fits(sli_word word, sli_word pattern) {
    const bool before = pattern.at[0] == '*', behind = pattern.at[pattern.length - 1] == '*';
    const sli_word plain = {pattern.at + before, pattern.length - before - behind};
    if (word.length < plain.length) return false;
    if (before) return behind ? has_part(word, plain) : ends_with(word, plain);
    if (memcmp(word.at, plain.at, plain.length) != 0) return false;
    const sli_word ending = {word.at + plain.length, word.length - plain.length};
    return behind || !ending.length || sli_word_is(ending, "s") || sli_word_is(ending, "es");
}

static bool fits_any(sli_word word, const char *patterns) {
    for (const char *at = patterns; *at;) {
        const size_t length = strcspn(at, " ");
        if (fits(word, (sli_word){at, length})) return true;
        at += length + (at[length] == ' ');
    }
    return false;
}

static sli_meaning meaning_of_word(sli_word word) {
    for (int i = SLI_MEANINGS - 1; i > SLI_MEANS_NOTHING; i--)
        if (fits_any(word, lists[i].patterns)) return (sli_meaning)i;
    return SLI_MEANS_NOTHING;
}

// --- codes and parts

/// Layer codes of ISO 13567 ("A-21----E-N"): two characters of the agent, six of the element,
/// beginning with its number in the table, two of the presentation.
static sli_meaning meaning_of_code(sli_word name) {
    static const struct {
        const char *begins;
        sli_meaning meaning;
    } elements[] = {
        {"21", SLI_MEANS_WALL},     {"22", SLI_MEANS_WALL}, {"28", SLI_MEANS_WALL},
        {"31", SLI_MEANS_WINDOW},   {"32", SLI_MEANS_DOOR}, {"24", SLI_MEANS_STAIRS},
        {"34", SLI_MEANS_STAIRS},   {"4", SLI_MEANS_HATCH}, {"5", SLI_MEANS_FURNITURE},
        {"6", SLI_MEANS_FURNITURE}, {"9", SLI_MEANS_SITE},  {"7", SLI_MEANS_FURNITURE},
        {"2", SLI_MEANS_OTHER},     {"3", SLI_MEANS_OTHER},
    };
    if (name.length < 10 || name.at[0] < 'A' || name.at[0] > 'Z') return SLI_MEANS_NOTHING;
    for (size_t i = 1; i < name.length; i++) {
        const char c = name.at[i];
        const bool letter = c >= 'A' && c <= 'Z', digit = c >= '0' && c <= '9';
        if (!digit && c != '-' && c != '_' && !(letter && (i < 2 || i > 7)))
            return SLI_MEANS_NOTHING;
    }
    if (!(name.at[3] >= '0' && name.at[3] <= '9')) return SLI_MEANS_NOTHING;
    if (name.at[8] == 'T' || name.at[8] == 'D' || name.at[8] == 'A') return SLI_MEANS_TEXT;
    if (name.at[8] == 'H') return SLI_MEANS_HATCH;
    for (size_t i = 0; i < sizeof elements / sizeof *elements; i++)
        if (memcmp(name.at + 2, elements[i].begins, strlen(elements[i].begins)) == 0)
            return elements[i].meaning;
    return SLI_MEANS_NOTHING;
}

static sli_meaning meaning_of_part(sli_word name) {
    const char *at = name.at, *const end = name.at + name.length;
    char text[LONGEST];
    sli_meaning found = meaning_of_code(name), before = found, last = SLI_MEANS_NOTHING;
    for (sli_word word = next_word(&at, end, text); word.length; word = next_word(&at, end, text)) {
        // "BedRoom": furniture that says which room it is.
        if (last == SLI_MEANS_FURNITURE && fits_any(word, rooms)) found = before;
        last = meaning_of_word(word);
        before = found;
        if (last > found) found = last;
    }
    return found;
}

/// Where the last part of a name begins, behind the names of other drawings.
static size_t last_part(sli_word name) {
    size_t begin = 0;
    for (size_t i = 0; i < name.length; i++) {
        size_t digits = i + 1;
        while (digits < name.length && name.at[digits] >= '0' && name.at[digits] <= '9') digits++;
        if (name.at[i] == '|') begin = i + 1;
        if (name.at[i] == '$' && digits > i + 1 && digits < name.length && name.at[digits] == '$')
            begin = digits + 1;
    }
    return begin;
}

/// Whether all words of a name are in a list.
static bool is_all(sli_word name, const char *patterns) {
    const char *at = name.at, *const end = name.at + name.length;
    char text[LONGEST];
    bool any = false;
    for (sli_word word = next_word(&at, end, text); word.length; word = next_word(&at, end, text)) {
        if (!fits_any(word, patterns)) return false;
        any = true;
    }
    return any;
}

sli_meaning sli_meaning_of(sli_word name) {
    const size_t begin = last_part(name);
    if (is_all(name, outside)) return SLI_MEANS_SITE;
    const sli_meaning last = meaning_of_part((sli_word){name.at + begin, name.length - begin});
    return last || !begin ? last : meaning_of_part((sli_word){name.at, begin});
}

bool sli_meaning_is_wall_too(sli_word name) {
    const char *at = name.at, *const end = name.at + name.length;
    char text[LONGEST];
    bool wall = false;
    for (sli_word word = next_word(&at, end, text); word.length; word = next_word(&at, end, text)) {
        if (fits_any(word, GLASS)) return false;
        wall |= fits_any(word, lists[SLI_MEANS_WALL].patterns);
    }
    return wall;
}

bool sli_meaning_is_rooms(sli_word name) {
    return is_all(name, rooms);
}

bool sli_meaning_is_nodes(sli_word name) {
    return is_all(name, ROUTE_NODES);
}

bool sli_meaning_is_edges(sli_word name) {
    return is_all(name, edges);
}

bool sli_meaning_is_way_in(sli_word name) {
    const char *at = name.at, *const end = name.at + name.length;
    char text[LONGEST];
    for (sli_word word = next_word(&at, end, text); word.length; word = next_word(&at, end, text))
        if (fits_any(word, ways_in)) return true;
    return false;
}
