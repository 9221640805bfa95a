# Untried. URL and checksum are those of a release archive, once there is one.
class Sightline < Formula
  desc "2D cell-and-portal visibility toolkit"
  license all_of: ["MIT", "GPL-3.0-or-later"] # the second because of GLPK
  head "https://example.org/sightline.git", branch: "main"

  depends_on "cmake" => :build
  depends_on "ninja" => :build
  depends_on "pkgconf" => :build
  depends_on "cairo"
  depends_on "glpk"
  depends_on "jansson"
  depends_on "libpng"
  depends_on "libxml2"
  depends_on "libyaml"
  depends_on "pango"
  depends_on "sdl2"
  depends_on "zstd"
  uses_from_macos "zlib"

  def install
    system "cmake", "-S", ".", "-B", "build", "-G", "Ninja", "-DBUILD_SHARED_LIBS=ON",
           "-DSIGHTLINE_TESTS=OFF", *std_cmake_args
    system "cmake", "--build", "build"
    system "cmake", "--install", "build"
  end

  test do
    system bin/"sightline", "bake", pkgshare/"maps/office.map", "-o", "office.slv"
    assert_match "107", shell_output("#{bin}/sightline info office.slv")
  end
end
