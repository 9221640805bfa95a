// What the class Level answers about who walks, boxes and servers: Calls.exe LEVEL.slv
using System;
using System.Globalization;

public static class Calls
{
    public static void Main(string[] arguments)
    {
        CultureInfo.DefaultThreadCurrentCulture = CultureInfo.CurrentCulture = CultureInfo.InvariantCulture;
        using (Level level = new Level(System.IO.File.ReadAllBytes(arguments[0])))
        {
            Console.WriteLine(level.CanWalk(5.1, 5.03, 5.2, 5.03) + " " + level.CanWalk(5.1, 5.03, 99, 5.03));
            double[] at;
            Console.WriteLine(level.Walk(5.1, 5.03, 99, 7, 0.25, out at) + " " + at[0].ToString("R") + " " + at[1].ToString("R"));
            double[] things = { 5, 5, 5.5, 5.5, 12.3, 7.1, 12.5, 7.2, 90, 90, 91, 91 };
            bool[,] relevant = level.Relevant(new double[] { 5, 5, 5.2, 5.2, 12.3, 7.1, 12.4, 7.2 }, 0.25, things);
            foreach (bool each in relevant) Console.Write(each + " ");
            Console.WriteLine(relevant.GetLength(0) + " " + relevant.GetLength(1));
            Console.WriteLine(level.BoxesSeen(5.1, 5.03).Length);
            Console.WriteLine(level.Settle(1000000));
            Console.WriteLine(level.SetBoxCount(2));
            level.MoveBox(0, 5.3, 4.8, 5.4, 5.2, true);
            level.MoveBox(1, 5.6, 5, 5.7, 5.1, false);
            foreach (bool each in level.BoxesSeen(5.1, 5.03)) Console.Write(each + " ");
            Console.WriteLine(level.CanWalk(5.1, 5.03, 5.5, 5.03) + " " + level.CanWalk(5.1, 5.03, 5.5, 5.03, 0));
        }
    }
}
