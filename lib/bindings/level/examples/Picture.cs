// Fog of war as a picture: what an eye sees of a baked level, in the coordinates of the map's own file. C#, with Mono or .NET.
//
//     mcs -main:Picture Picture.cs Seen.cs && mono Picture.exe LEVEL.slv X Y PICTURE.svg
//
// Seen.cs has the class Level.
using System;
using System.Globalization;
using System.IO;
using System.Linq;

public static class Picture
{
    public static void Main(string[] arguments)
    {
        CultureInfo.DefaultThreadCurrentCulture = CultureInfo.CurrentCulture = CultureInfo.InvariantCulture;
        double x = double.Parse(arguments[1]), y = double.Parse(arguments[2]);
        using (Level level = new Level(File.ReadAllBytes(arguments[0])))
        using (StreamWriter svg = new StreamWriter(arguments[3]))
        {
            level.UseFileCoordinates();
            Draw(level, x, y, svg);
        }
    }

    private static void Draw(Level level, double x, double y, TextWriter svg)
    {
        double[] b = level.Bounds;
        double width = b[2] - b[0], height = b[3] - b[1], up = level.YIsDown ? 1 : -1; // y is up in map text
        svg.WriteLine("<svg xmlns='http://www.w3.org/2000/svg' width='900' viewBox='{0:R} {1:R} {2:R} {3:R}'>",
                      b[0], up > 0 ? b[1] : -b[3], width, height);
        svg.WriteLine("<g transform='scale(1 {0})' shape-rendering='crispEdges'>", up);
        for (int cell = 0; cell < level.CellCount; cell++)
            Polygon(svg, level.CellCorners(cell), level.IsSolid(cell) ? "#1a1a1a" : "#737380");
        Polygon(svg, level.VisiblePolygon(x, y), "#ffed99");
        svg.WriteLine("<circle cx='{0:R}' cy='{1:R}' r='{2:R}'/>\n</g>\n</svg>", x, y, 0.005 * (width + height));
    }

    private static void Polygon(TextWriter svg, double[] points, string colour)
    {
        svg.WriteLine("<polygon fill='{0}' points='{1}'/>", colour, string.Join(" ", points.Select(p => p.ToString("R"))));
    }
}
