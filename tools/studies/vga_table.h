/// The measures of `sightline vga` as a table: its columns, the files that it is written to, and a
/// summary of it.
#ifndef VGA_TABLE_H
#define VGA_TABLE_H

#include "sightline/vga.h"
#include "studies/isovist.h"

/// What is measured of each point. A group of measures is a bit by its place in vga_parts().
typedef struct vga_table {
    sl_vga_grid grid;
    sl_vga_measures *measures;
    isovist_result *isovists;   ///< NULL where they are not measured
    sl_vga_interval *estimated; ///< ends of the mean depth; NULL where it is exact
    sl_vga_depths *depths;      ///< from chosen points; NULL where there are none
    uint64_t *gates;            ///< steps of agents; NULL where there are none
    unsigned parts;
    bool global_only; ///< of the visual measures those of the whole graph alone
    uint32_t *part;   ///< by point: of those that no sightline joins (sl_vga_parts); NULL: unknown
    uint32_t part_count;
    sl_earth earth;             ///< where the map lies (sl_map.earth)
    const char *const *storeys; ///< by point, of a building; NULL for one plan
} vga_table;

enum { VGA_PART_VISUAL = 1, VGA_PART_THROUGH = 2, VGA_PART_METRIC = 4, VGA_PART_ANGULAR = 8 };
enum { VGA_PART_ISOVIST = 16, VGA_PART_ALL = 32 };
/// What is measured from chosen points: the groups from this bit on.
enum { VGA_PART_STEPS = 64, VGA_PART_STEP_LENGTHS = VGA_PART_STEPS * VGA_PART_METRIC };
enum { VGA_PART_STEP_TURNS = VGA_PART_STEPS * VGA_PART_ANGULAR, VGA_PART_AGENTS = 1024 };

/// The groups that can be chosen, numbered as the bits are; the last is "all".
name_table vga_parts(void);

/// The group of a measure, by its place in the table of SL_VGA.
unsigned vga_measure_part(size_t measure);

/// Whether a measure goes by the part of the graph that a point is in: not that of its own region,
/// nor from chosen points, nor of agents.
bool vga_measure_is_of_part(size_t measure);

/// Whether the table has a column of a measure. Of the visual ones some are not estimated, and
/// local ones may be left out.
bool vga_has(const vga_table *table, size_t measure);

/// Whether a measure stays where local ones are left out.
bool vga_is_global(size_t measure);

/// Whether a measure stays where mean depths are estimated.
bool vga_is_estimated(size_t measure);

/// NAN where the measure is not defined.
double vga_value(const vga_table *table, size_t measure, uint32_t point);

/// Writes the columns of the table's groups: GeoJSON where the name ends so, else CSV. "-" is
/// stdout. Of a part of the table its rows are written.
sl_status vga_write(sl_context *context, const vga_table *table, const table_part *part,
                    const char *path);

/// The number of points in one of several parts.
uint32_t vga_part_size(const vga_table *table, uint32_t part);

/// Prints mean and standard deviation of each column, and the ten highest values of one. Of several
/// parts the largest has these figures, and of the others only that one mean is printed.
void vga_print_summary(const vga_table *table, size_t measure);

#endif
