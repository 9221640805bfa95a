// What an eye sees of a baked level, with doors opened and shut by name: C#, with Mono or .NET.
//
//     mcs Seen.cs && mono Seen.exe LEVEL.slv X Y [open NAME | shut NAME]...
//
// The system must find the shared library sightline_level (Linux: LD_LIBRARY_PATH).
using System;
using System.Globalization;
using System.Runtime.InteropServices;
using System.Text;

/// A baked level. One thread at a time.
public sealed class Level : IDisposable
{
    private const string Library = "sightline_level";
    private IntPtr handle;

    [DllImport(Library)] private static extern IntPtr sl_level_open(byte[] bytes, UIntPtr size);
    [DllImport(Library)] private static extern IntPtr sl_level_error();
    [DllImport(Library)] private static extern void sl_level_close(IntPtr level);
    [DllImport(Library)] private static extern int sl_level_use_file_coordinates(IntPtr level);
    [DllImport(Library)] private static extern int sl_level_y_is_down(IntPtr level);
    [DllImport(Library)] private static extern void sl_level_bounds(IntPtr level, double[] bounds);
    [DllImport(Library)] private static extern int sl_level_cell_count(IntPtr level);
    [DllImport(Library)] private static extern IntPtr sl_level_cell_corners(IntPtr level, int cell, out int count);
    [DllImport(Library)] private static extern int sl_level_is_solid(IntPtr level, int cell);
    [DllImport(Library)] private static extern int sl_level_find_door(IntPtr level, byte[] name, int from);
    [DllImport(Library)] private static extern int sl_level_set_door(IntPtr level, int door, int open);
    [DllImport(Library)] private static extern int sl_level_settle(IntPtr level, int portals);
    [DllImport(Library)] private static extern int sl_level_locate(IntPtr level, double x, double y);
    [DllImport(Library)] private static extern int sl_level_can_see(IntPtr level, int from, int to);
    [DllImport(Library)] private static extern int sl_level_sees(IntPtr level, double x0, double y0, double x1,
                                                                 double y1);
    [DllImport(Library)] private static extern IntPtr sl_level_look(IntPtr level, double x, double y, double heading,
                                                                    double fov, double range, out int count);
    [DllImport(Library)] private static extern IntPtr sl_level_visible_polygon(
        IntPtr level, double x, double y, double heading, double fov, double range, out int count);
    [DllImport(Library)] private static extern int sl_level_can_walk(IntPtr level, double x0, double y0, double x1,
                                                                     double y1, int own);
    [DllImport(Library)] private static extern int sl_level_walk(IntPtr level, double x0, double y0, double x1,
                                                                 double y1, double radius, int own, double[] at);
    [DllImport(Library)] private static extern IntPtr sl_level_relevant(
        IntPtr level, double[] players, int playerCount, double margin, double[] things, int thingCount);
    [DllImport(Library)] private static extern int sl_level_set_box_count(IntPtr level, int count);
    [DllImport(Library)] private static extern void sl_level_move_box(
        IntPtr level, int box, double minX, double minY, double maxX, double maxY, int blocks);
    [DllImport(Library)] private static extern IntPtr sl_level_boxes_seen(
        IntPtr level, double x, double y, double heading, double fov, double range, out int count);

    public Level(byte[] bytes)
    {
        handle = sl_level_open(bytes, (UIntPtr)bytes.Length);
        if (handle == IntPtr.Zero) throw new FormatException(Marshal.PtrToStringAnsi(sl_level_error()));
    }

    public void Dispose()
    {
        sl_level_close(handle);
        handle = IntPtr.Zero;
    }

    /// All places are then those of the map's own file; false if the level does not have them.
    public bool UseFileCoordinates() { return sl_level_use_file_coordinates(handle) == 1; }

    public bool YIsDown { get { return sl_level_y_is_down(handle) == 1; } }

    /// Min x, min y, max x, max y.
    public double[] Bounds
    {
        get
        {
            double[] bounds = new double[4];
            sl_level_bounds(handle, bounds);
            return bounds;
        }
    }

    public int CellCount { get { return sl_level_cell_count(handle); } }

    /// x and y of each corner, counter-clockwise.
    public double[] CellCorners(int cell)
    {
        int count;
        return Points(sl_level_cell_corners(handle, cell, out count), count);
    }

    public bool IsSolid(int cell) { return sl_level_is_solid(handle, cell) == 1; }

    private static double[] Points(IntPtr answer, int count)
    {
        double[] points = new double[2 * count];
        if (count > 0) Marshal.Copy(answer, points, 0, points.Length);
        return points;
    }

    /// Opens or shuts all doors of a name, breaks a wall or builds one; false if there is none, and
    /// for a wall that is broken or built already.
    public bool SetDoor(string name, bool open)
    {
        int door = sl_level_find_door(handle, Encoding.UTF8.GetBytes(name + "\0"), 0);
        return sl_level_set_door(handle, door, open ? 1 : 0) != 0;
    }

    /// Makes CanSee exact for the doors as they stand, through some more portals. How many rows are left.
    public int Settle(int portals) { return sl_level_settle(handle, portals); }

    /// The cell of a point; -1 for none.
    public int Locate(double x, double y) { return sl_level_locate(handle, x, y); }

    public bool CanSee(int from, int to) { return sl_level_can_see(handle, from, to) == 1; }

    public bool Sees(double x0, double y0, double x1, double y1)
    {
        return sl_level_sees(handle, x0, y0, x1, y1) == 1;
    }

    /// The cells that an eye sees.
    public int[] Look(double x, double y, double heading = 0, double fov = 360, double range = 0)
    {
        int count;
        IntPtr answer = sl_level_look(handle, x, y, heading, fov, range, out count);
        int[] cells = new int[count];
        if (count > 0) Marshal.Copy(answer, cells, 0, count);
        return cells;
    }

    /// The polygon that an eye sees: x and y of each corner, counter-clockwise.
    public double[] VisiblePolygon(double x, double y, double heading = 0, double fov = 360, double range = 0)
    {
        int count;
        return Points(sl_level_visible_polygon(handle, x, y, heading, fov, range, out count), count);
    }

    /// Whether one may walk straight there. Box `own` does not stop it: that of who walks.
    public bool CanWalk(double x0, double y0, double x1, double y1, int own = -1)
    {
        return sl_level_can_walk(handle, x0, y0, x1, y1, own) == 1;
    }

    /// Moves a disc toward a point, along what stops it; `at` is the x and y that it comes to. True if it comes there.
    public bool Walk(double x0, double y0, double x1, double y1, double radius, out double[] at, int own = -1)
    {
        at = new double[2];
        return sl_level_walk(handle, x0, y0, x1, y1, radius, own, at) == 1;
    }

    /// Which things each player may see: answer[player, thing]. Of each box min x, min y, max x, max y.
    public bool[,] Relevant(double[] players, double margin, double[] things)
    {
        bool[,] answer = new bool[players.Length / 4, things.Length / 4];
        int lookers = answer.GetLength(0), seen = answer.GetLength(1), row = (seen + 7) / 8;
        byte[] bits = new byte[lookers * row];
        IntPtr found = sl_level_relevant(handle, players, lookers, margin, things, seen);
        if (found == IntPtr.Zero) throw new OutOfMemoryException();
        Marshal.Copy(found, bits, 0, bits.Length);
        for (int p = 0; p < lookers; p++)
            for (int t = 0; t < seen; t++) answer[p, t] = (bits[p * row + t / 8] >> t % 8 & 1) == 1;
        return answer;
    }

    /// Makes room for boxes, which are nowhere yet; false if memory is short.
    public bool SetBoxCount(int count) { return sl_level_set_box_count(handle, count) == 1; }

    /// Puts a box at a place. One that blocks hides what is behind it and stops who walks.
    public void MoveBox(int box, double minX, double minY, double maxX, double maxY, bool blocks)
    {
        sl_level_move_box(handle, box, minX, minY, maxX, maxY, blocks ? 1 : 0);
    }

    /// Which boxes an eye sees.
    public bool[] BoxesSeen(double x, double y, double heading = 0, double fov = 360, double range = 0)
    {
        int count;
        IntPtr answer = sl_level_boxes_seen(handle, x, y, heading, fov, range, out count);
        bool[] seen = new bool[count];
        for (int i = 0; i < count; i++) seen[i] = Marshal.ReadByte(answer, i) == 1;
        return seen;
    }
}

public static class Seen
{
    public static int Main(string[] arguments)
    {
        CultureInfo.DefaultThreadCurrentCulture = CultureInfo.CurrentCulture = CultureInfo.InvariantCulture;
        double x = double.Parse(arguments[1]), y = double.Parse(arguments[2]);
        try
        {
            using (Level level = new Level(System.IO.File.ReadAllBytes(arguments[0])))
                return Print(level, x, y, arguments);
        }
        catch (FormatException fault)
        {
            Console.Error.WriteLine("seen: " + arguments[0] + ": " + fault.Message);
            return 2;
        }
    }

    private static int Print(Level level, double x, double y, string[] arguments)
    {
        for (int i = 3; i + 1 < arguments.Length; i += 2)
            if (!level.SetDoor(arguments[i + 1], arguments[i] == "open"))
            {
                Console.Error.WriteLine("seen: there is no door " + arguments[i + 1]);
                return 2;
            }
        int cell = level.Locate(x, y);
        Console.WriteLine("cell " + cell);
        Console.Write("row");
        for (int i = 0; i < level.CellCount; i++)
            if (level.CanSee(cell, i)) Console.Write(" " + i);
        int[] cells = level.Look(x, y);
        Array.Sort(cells);
        Console.Write("\nseen");
        foreach (int each in cells) Console.Write(" " + each);
        double[] points = level.VisiblePolygon(x, y);
        Console.WriteLine("\npoints " + points.Length / 2);
        for (int i = 0; i < points.Length; i += 2)
            Console.WriteLine(points[i].ToString("R") + " " + points[i + 1].ToString("R"));
        return 0;
    }
}
