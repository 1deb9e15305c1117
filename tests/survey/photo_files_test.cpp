// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/photo_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "survey/error.h"
#include "survey/files.h"
#include "tests/survey/support.h"

namespace stucco {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr char kJpegStart[] = "\xff\xd8\xff\xe0";

// A folder with files in folders.
class TempFolder : public test::TemporaryFolder {
 public:
  void Write(const std::string& name, const std::string& bytes) const {
    std::filesystem::create_directories((path() / name).parent_path());
    WriteFile(path() / name, bytes);
  }
};

std::vector<std::string> Paths(const std::vector<PhotoFile>& files) {
  std::vector<std::string> paths;
  for (const PhotoFile& file : files) paths.push_back(file.path);
  return paths;
}

TEST(FindPhotoFiles, WalksSortedWithSlashes) {
  const TempFolder folder;
  for (const char* name : {"b.jpg", "a.JPG", "flight 2/x.jpeg", "flight 2/deep/y.jpg", "B.jpg"}) {
    folder.Write(name, "x");
  }
  EXPECT_THAT(Paths(FindPhotoFiles(folder.path())),
              ElementsAre("B.jpg", "a.JPG", "b.jpg", "flight 2/deep/y.jpg", "flight 2/x.jpeg"));
}

TEST(FindPhotoFiles, SkipsWhatIsNoPhoto) {
  const TempFolder folder;
  for (const char* name : {".hidden.jpg", ".trash/a.jpg", "._a.jpg", "K.txt", "flight.MRK", "a.xml",
                           "a_mask.png", "a.mask.png", "a.jpg.png", "a.dng", "no_extension"}) {
    folder.Write(name, "x");
  }
  folder.Write("a.jpg", "x");
  EXPECT_THAT(Paths(FindPhotoFiles(folder.path())), ElementsAre("a.jpg"));
}

TEST(FindPhotoFiles, FindsAJpegByItsContent) {
  const TempFolder folder;
  folder.Write("IMG_0001", kJpegStart);
  folder.Write("no_photo", "x");
  EXPECT_THAT(Paths(FindPhotoFiles(folder.path())), ElementsAre("IMG_0001"));
}

TEST(FindPhotoFiles, PreviewsOfCamerasAndWhatSystemsKeepAreNoPhotos) {
  const TempFolder folder;
  for (const char* name :
       {"photo.bin", "DJI_0001.THM", "DJI_0001.scr", "$RECYCLE.BIN/a.jpg", "$Recycle.Bin/b.jpg",
        "System Volume Information/a.jpg", "lost+found/a.jpg", "@eaDir/a.jpg/SYNOPHOTO_M.jpg",
        "#recycle/a.jpg", ".Trashes/a.jpg", "DCIM/@eaDir/a.jpg"}) {
    folder.Write(name, kJpegStart);
  }
  folder.Write("DCIM/a.jpg", kJpegStart);
  const PhotoListing listing = ListPhotoFiles(folder.path());
  EXPECT_THAT(Paths(listing.files), ElementsAre("DCIM/a.jpg"));
  EXPECT_EQ(listing.other_files, 3U);
}

// Gives up root's right to read everything as long as it lives.
class AsNobody {
 public:
  AsNobody() : was_root_(geteuid() == 0) {
    if (was_root_ && seteuid(65534) != 0) ADD_FAILURE() << "cannot give up root's rights";
  }
  ~AsNobody() {
    if (was_root_ && seteuid(0) != 0) ADD_FAILURE() << "cannot be root again";
  }
  AsNobody(const AsNobody&) = delete;
  AsNobody& operator=(const AsNobody&) = delete;

 private:
  bool was_root_;
};

TEST(FindPhotoFiles, AFolderThatCannotBeReadCostsOnlyItself) {
  namespace fs = std::filesystem;
  const TempFolder folder;
  folder.Write("a.jpg", "x");
  folder.Write("locked/b.jpg", "x");
  folder.Write("open/c.jpg", "x");
  fs::permissions(folder.path(), fs::perms(0755));
  fs::permissions(folder.path() / "locked", fs::perms::none);
  std::vector<PhotoFile> files;
  {
    const AsNobody nobody;
    files = FindPhotoFiles(folder.path());
  }
  fs::permissions(folder.path() / "locked", fs::perms(0755));
  ASSERT_THAT(Paths(files), ElementsAre("a.jpg", "locked", "open/c.jpg"));
  EXPECT_THAT(files[0].problem, IsEmpty());
  EXPECT_THAT(files[1].problem, HasSubstr("cannot be read (Permission denied)"));
}

TEST(FindPhotoFiles, ListsPicturesOfOtherKindsWithWhatToDo) {
  const TempFolder folder;
  folder.Write("a.heic", "x");
  folder.Write("b.TIF", "x");
  const auto files = FindPhotoFiles(folder.path());
  ASSERT_EQ(files.size(), 2U);
  EXPECT_THAT(files[0].problem, HasSubstr("heic"));
  EXPECT_THAT(files[0].problem, HasSubstr("convert"));
}

TEST(FindPhotoFiles, FollowsLinksButNoLoops) {
  const TempFolder folder;
  const TempFolder elsewhere;
  folder.Write("a.jpg", "x");
  elsewhere.Write("b.jpg", "x");
  std::filesystem::create_directory_symlink(folder.path(), folder.path() / "loop");
  std::filesystem::create_directory_symlink(elsewhere.path(), folder.path() / "linked");
  std::filesystem::create_symlink("nowhere.jpg", folder.path() / "dangling.jpg");
  EXPECT_THAT(Paths(FindPhotoFiles(folder.path())), ElementsAre("a.jpg", "linked/b.jpg"));
}

TEST(FindPhotoFiles, NamesThatCannotBeWrittenDownAreListedSafely) {
  const TempFolder folder;
  folder.Write("bad\xff.jpg", "x");
  folder.Write("line\nbreak.jpg", "x");
  folder.Write("straße 😀.jpg", "x");
  const auto files = FindPhotoFiles(folder.path());
  ASSERT_EQ(files.size(), 3U);
  EXPECT_EQ(files[0].path, "bad?.jpg");
  EXPECT_EQ(files[0].file, "bad\xff.jpg");
  EXPECT_THAT(files[0].problem, HasSubstr("rename"));
  EXPECT_EQ(files[1].path, "line?break.jpg");
  EXPECT_EQ(files[2].path, "straße 😀.jpg");
  EXPECT_THAT(files[2].problem, IsEmpty());
}

TEST(FindPhotoFiles, MissingFolderAndFileInItsPlaceAreErrors) {
  const TempFolder folder;
  folder.Write("a.jpg", "x");
  for (const auto& path : {folder.path() / "missing", folder.path() / "a.jpg"}) {
    try {
      FindPhotoFiles(path);
      FAIL() << path;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
      EXPECT_THAT(error.what(), HasSubstr(path.string()));
      EXPECT_NE(error.remedy(), "");
    }
  }
}

}  // namespace
}  // namespace stucco
